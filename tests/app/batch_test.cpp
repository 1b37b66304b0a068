#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <map>
#include <random>
#include <sstream>
#include <string_view>
#include <thread>

#include "command_line.hpp"

// `turnwright batch` as a user meets it, and whatever may befall it.
namespace turnwright::app {
namespace {

constexpr bool kSanitized = !std::string_view(TURNWRIGHT_SANITIZE).empty();

using Files = std::map<std::string, std::string>;

Files files_of(const fs::path& folder) {
  Files all;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    all[fs::relative(entry.path(), folder).string()] =
        entry.is_directory() ? "" : contents(entry.path());
  return all;
}

std::string acceptance(int i) {
  return R"({"name": "acceptance", "document": {"cases": [{"id": "c)" +
         std::to_string(i) +
         R"(", "tolerance": "diameter", "e_mm": [0, 0.004], "upper_mm": 0.0)" +
         std::to_string(10 + i % 7) + R"(, "lower_mm": 0}]}})";
}

std::string multipass(int i) {
  return R"({"name": "multipass", "document": {"dt_mm": )" +
         std::to_string(6 + 0.01 * i) + "}}";
}

/// Requests with a line that is no request, a blank one and an infeasible one among them.
std::string mixed_lines(int count, std::string (*good)(int)) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    if (i % 9 == 4)
      text += "{\"name\": \"plane\"}";
    else if (i % 9 == 6)
      text += R"({"name": "multipass", "document": {"FU": 1}})";
    else if (i % 9 != 7)
      text += good(i);
    text += '\n';
  }
  return text;
}

/// Whether all is asked for that may take minutes; else a part of it.
bool thorough() { return std::getenv("TURNWRIGHT_THOROUGH") != nullptr; }

class Batch : public CommandLine {
 protected:
  /// What a run that nothing disturbs leaves.
  Files undisturbed(const std::string& options) const {
    const auto run = shell("turnwright batch lines.jsonl -o whole " + options);
    EXPECT_EQ(run.code, 0) << run.err;
    return files_of(folder_ / "whole");
  }
  Outcome batch(const std::string& more = "") const {
    return shell("turnwright batch lines.jsonl -o results " + more);
  }
  std::string manifest() const { return contents(folder_ / "results/manifest.json"); }
};

TEST_F(Batch, AnswersEveryLineInOrder) {
  put(folder_ / "lines.jsonl", mixed_lines(30, acceptance));
  const auto run = batch("--chunk 7");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(run.out,
            "results/results.jsonl: 27 records, 21 ok, 3 infeasible, 3 errors\n");
  const auto files = files_of(folder_ / "results");
  ASSERT_EQ(files.size(), 3U);
  std::istringstream records(files.at("results.jsonl"));
  int expected = 0;
  for (std::string line; std::getline(records, line);) {
    const auto record = nlohmann::json::parse(line);
    ++expected;
    if (expected % 9 == 8) ++expected;  // blank
    ASSERT_EQ(record.at("line"), expected);
    const int i = expected - 1;
    const char* status = i % 9 == 4 ? "error" : i % 9 == 6 ? "infeasible" : "ok";
    EXPECT_EQ(record.at("status"), status) << line;
    if (record.at("status") == "ok") {
      EXPECT_EQ(record.at("result").at("cases").at(0).at("id"), "c" + std::to_string(i));
    }
  }
  EXPECT_EQ(expected, 30);
  const auto summary = nlohmann::json::parse(files.at("summary.json"));
  EXPECT_EQ(summary.at("records"), 27);
  EXPECT_EQ(summary.at("infeasible"), 3);
  EXPECT_EQ(summary.at("results").at("bytes"), files.at("results.jsonl").size());
  // A second run finds it done.
  EXPECT_EQ(batch().out, run.out);
  EXPECT_EQ(files_of(folder_ / "results"), files);
}

TEST_F(Batch, TheExampleOfItsHelpRuns) {
  const auto help = shell("turnwright batch --help").out;
  const auto at = help.find("Example");
  ASSERT_NE(at, std::string::npos);
  const auto run = shell("set -e" + help.substr(help.find('\n', at)));
  EXPECT_EQ(run.out, "depths/results.jsonl: 2 records, 2 ok, 0 infeasible, 0 errors\n");
  EXPECT_EQ(run.err, "");
}

TEST_F(Batch, ABadLineIsARecordWithItsNumber) {
  put(folder_ / "lines.jsonl",
      "{\"name\": \n" + acceptance(1) +
          "\n{\"name\": \"multipass\", \"document\": {\"dt_mm\": -1, \"colour\": 3}}\n" +
          std::string(2'000'001, ' ') + "{}\n" + std::string(100, '[') +
          "\n\xff\xfe\n{\"name\": \"plan\", \"document\": {}, \"more\": 1}");
  EXPECT_EQ(batch().out,
            "results/results.jsonl: 7 records, 1 ok, 0 infeasible, 6 errors\n");
  std::istringstream in(contents(folder_ / "results/results.jsonl"));
  std::vector<std::string> records;
  for (std::string line; std::getline(in, line);) records.push_back(line);
  ASSERT_EQ(records.size(), 7U);
  EXPECT_EQ(
      records[0],
      R"({"line":1,"status":"error","title":"wrong line","errors":[{"pointer":"",)"
      R"("got":"broken JSON at line 1, column 10: unexpected end of input in value",)"
      R"("expected":"'[', '{', or a literal","code":"syntax"}]})");
  EXPECT_EQ(
      records[2],
      R"({"line":3,"name":"multipass","status":"error","title":"wrong input","errors":)"
      R"([{"pointer":"/dt_mm","got":"-1","expected":"a number > 0 and <= 1000000 mm",)"
      R"("code":"range"},{"pointer":"/colour","got":"3","expected":"no such key",)"
      R"("code":"unknown-key"}]})");
  EXPECT_EQ(
      records[3],
      R"({"line":4,"status":"error","title":"wrong line","errors":[{"pointer":"",)"
      R"("got":"2000001 bytes","expected":"at most 2000000 bytes","code":"size"}]})");
  EXPECT_NE(records[4].find("nested too deeply"), std::string::npos);
  EXPECT_EQ(records[5].rfind(R"({"line":6,"status":"error")", 0), 0U);
  EXPECT_NE(records[6].find("/more"), std::string::npos);
}

TEST_F(Batch, BytesDependNeitherOnJobsNorOnShardsNorOnChunks) {
  put(folder_ / "lines.jsonl", mixed_lines(24, multipass));
  const auto whole = undisturbed("--jobs 1 --chunk 7");
  for (const std::string jobs : {"2", "5", "16"}) {
    fs::remove_all(folder_ / "results");
    EXPECT_EQ(batch("--chunk 7 --jobs " + jobs).code, 0);
    EXPECT_EQ(files_of(folder_ / "results"), whole) << jobs;
  }
  fs::remove_all(folder_ / "results");
  for (const std::string shard : {"3/4", "1/4", "4/4", "2/4"}) {
    EXPECT_FALSE(fs::exists(folder_ / "results/results.jsonl"));
    const auto run = batch("--chunk 7 --shard " + shard);
    EXPECT_EQ(run.out, "shard " + shard + " is done\n");
  }
  EXPECT_EQ(batch().code, 0);
  EXPECT_EQ(files_of(folder_ / "results"), whole);
  fs::remove_all(folder_ / "results");
  EXPECT_EQ(batch("--chunk 1").code, 0);
  EXPECT_EQ(contents(folder_ / "results/results.jsonl"), whole.at("results.jsonl"));
}

TEST_F(Batch, AFileWithoutALineGivesAnEmptyResult) {
  put(folder_ / "lines.jsonl", "");
  EXPECT_EQ(batch().out,
            "results/results.jsonl: 0 records, 0 ok, 0 infeasible, 0 errors\n");
  EXPECT_EQ(contents(folder_ / "results/results.jsonl"), "");
  put(folder_ / "lines.jsonl", "\n \r\n");
  EXPECT_EQ(shell("turnwright batch lines.jsonl -o blank").code, 0);
  EXPECT_EQ(contents(folder_ / "blank/results.jsonl"), "");
}

TEST_F(Batch, EqualRequestsAreComputedOnce) {
  // The titanium pin takes a good part of a second; 2000 of them would take minutes.
  auto part = nlohmann::json::parse(
      contents(fs::path(TURNWRIGHT_SOURCE_DIR) / "parts/titanium-pin.json"));
  const std::string line =
      nlohmann::json{{"name", "plan"}, {"document", part}}.dump() + '\n';
  std::string text;
  for (int i = 0; i < 2000; ++i) text += line;
  put(folder_ / "lines.jsonl", text);
  const auto run = shell("timeout 60 turnwright batch lines.jsonl -o results");
  EXPECT_EQ(run.out,
            "results/results.jsonl: 2000 records, 2000 ok, 0 infeasible, 0 errors\n");
  std::istringstream in(contents(folder_ / "results/results.jsonl"));
  std::string first, line_text;
  std::getline(in, first);
  first = first.substr(first.find(','));
  for (int i = 2; std::getline(in, line_text); ++i)
    ASSERT_EQ(line_text, "{\"line\":" + std::to_string(i) + first);
}

TEST_F(Batch, AnotherInputIsRefused) {
  const std::string text = mixed_lines(12, acceptance);
  put(folder_ / "lines.jsonl", text);
  EXPECT_EQ(batch("--shard 1/2 --chunk 4").code, 0);
  const auto before = files_of(folder_ / "results");
  put(folder_ / "lines.jsonl", text + acceptance(99) + '\n');
  const auto run = batch("--chunk 5");
  EXPECT_EQ(run.code, 2);
  EXPECT_EQ(run.out, "");
  const auto now = shell("sha256sum < lines.jsonl").out.substr(0, 64);
  put(folder_ / "lines.jsonl", text);
  const auto then = shell("sha256sum < lines.jsonl").out.substr(0, 64);
  EXPECT_EQ(run.err, "results/manifest.json: /input: got 13 lines, SHA-256 " + now +
                         ", expected 12 lines, SHA-256 " + then +
                         ", with which this batch was begun\n"
                         "results/manifest.json: /chunk_lines: got 5, expected 4, with "
                         "which this batch was begun\n");
  EXPECT_EQ(files_of(folder_ / "results"), before);
  EXPECT_EQ(batch().code, 0);
}

TEST_F(Batch, AFolderWithSomethingOfABatchsNamesIsRefused) {
  put(folder_ / "lines.jsonl", acceptance(1));
  fs::create_directories(folder_ / "elsewhere");
  put(folder_ / "elsewhere/0.jsonl", "precious");
  const std::vector<std::pair<std::string, std::string>> strangers{
      {"work", "mkdir work; echo precious > work/thesis.txt"},
      {"work", "mkdir work; echo precious > work/0.jsonl"},
      {"work", "ln -s ../elsewhere work"},
      {"work", "ln -s nowhere work"},
      {"work", "echo precious > work"},
      {"results.jsonl", "echo precious > results.jsonl"},
      {"summary.json", "echo precious > summary.json"}};
  for (const auto& [name, how] : strangers) {
    SCOPED_TRACE(how);
    fs::remove_all(folder_ / "results");
    EXPECT_EQ(shell("mkdir results && cd results && { " + how + "; }").code, 0);
    const auto before = shell("ls -lR results elsewhere").out;
    const auto run = batch();
    EXPECT_EQ(run.code, 2);
    EXPECT_EQ(run.err, "results/" + name +
                           ": document: got something of no batch: there is no "
                           "manifest.json, expected a folder without results.jsonl, "
                           "summary.json and work, or one that a batch was begun in\n");
    EXPECT_EQ(shell("ls -lR results elsewhere").out, before);
  }
  // What is not in the way stays, and so does what a run left that ended at its
  // beginning.
  fs::remove_all(folder_ / "results");
  fs::create_directories(folder_ / "results/work");
  put(folder_ / "results/work/.manifest.json.0123456789abcdef", "{");
  put(folder_ / "results/notes.txt", "mine");
  EXPECT_EQ(batch().code, 0);
  EXPECT_EQ(contents(folder_ / "results/notes.txt"), "mine");
  EXPECT_FALSE(fs::exists(folder_ / "results/work"));
}

TEST_F(Batch, OnlyItsOwnFilesAreRemovedAtTheEnd) {
  put(folder_ / "lines.jsonl", acceptance(1));
  EXPECT_EQ(batch("--shard 1/1").code, 0);
  fs::create_directories(folder_ / "elsewhere");
  put(folder_ / "elsewhere/0.jsonl", "precious");
  fs::create_directory_symlink("../../elsewhere", folder_ / "results/work/1.jsonl");
  put(folder_ / "results/work/notes.txt", "mine");
  EXPECT_EQ(batch().code, 0);
  EXPECT_EQ(contents(folder_ / "results/work/notes.txt"), "mine");
  EXPECT_FALSE(fs::exists(folder_ / "results/work/0.jsonl"));
  EXPECT_EQ(contents(folder_ / "elsewhere/0.jsonl"), "precious");
  // A folder that became a link after the beginning is not followed.
  fs::remove_all(folder_ / "results/work");
  fs::create_directory_symlink("../elsewhere", folder_ / "results/work");
  EXPECT_EQ(batch().code, 0);
  EXPECT_EQ(contents(folder_ / "elsewhere/0.jsonl"), "precious");
}

TEST_F(Batch, OtherDataAreRefused) {
  put(folder_ / "lines.jsonl", acceptance(1));
  EXPECT_EQ(batch("--shard 1/1").code, 0);
  fs::create_directory(folder_ / "data");
  for (const char* data : {"materials", "tools", "machines", "shops"})
    fs::copy(fs::path(TURNWRIGHT_SOURCE_DIR) / data, folder_ / "data" / data,
             fs::copy_options::recursive);
  EXPECT_EQ(shell("turnwright --data data batch lines.jsonl -o results").code, 0);
  fs::remove_all(folder_ / "results");
  EXPECT_EQ(batch("--shard 1/1").code, 0);
  std::ofstream(folder_ / "data/materials/C45.json", std::ios::app) << '\n';
  const auto run = shell("turnwright --data data batch lines.jsonl -o results");
  EXPECT_EQ(run.code, 2);
  EXPECT_EQ(run.err.rfind("results/manifest.json: /data_sha256: got ", 0), 0U) << run.err;
}

TEST_F(Batch, WrongUseIsTold) {
  put(folder_ / "lines.jsonl", acceptance(1));
  put(folder_ / "file", "old");
  const auto refused = [&](const std::string& command, int code,
                           const std::string& error) {
    const auto run = shell(command);
    EXPECT_EQ(run.code, code) << command;
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(run.err, error) << command;
  };
  refused("turnwright batch missing.jsonl -o results", 2,
          "missing.jsonl: document: got nothing readable, expected a file with one "
          "request a line\n");
  refused("turnwright batch - -o results < lines.jsonl", 2,
          "-: document: got nothing readable, expected a file with one request a line\n");
  refused("turnwright batch . -o results", 2,
          ".: document: got no regular file, expected a file with one request a line\n");
  refused("turnwright batch lines.jsonl -o file", 74,
          "file: cannot be written: Not a directory\n");
  for (const std::string shard : {"0/3", "4/3", "1", "1/", "a/b", "1/3x", "-1/3", " 1/3",
                                  "1/1000001", "1/99999999999"})
    refused("turnwright batch lines.jsonl -o results --shard='" + shard + '\'', 2,
            "command line: --shard: got \"" + shard +
                "\", expected i/n with 1 <= i <= n <= 1000000\n");
  for (const std::string wrong :
       {"", "-o results --jobs 0", "-o results --chunk 0",
        "-o results --slurm --shard 1/2", "-o results --slurm --reconcile",
        "-o results --slurm --task-lines 0"})
    EXPECT_EQ(shell("turnwright batch lines.jsonl " + wrong).code, 2) << wrong;
  EXPECT_EQ(files(), (std::vector<std::string>{"file", "lines.jsonl"}));
  fs::create_directory(folder_ / "mine");
  put(folder_ / "mine/results.jsonl", "mine");
  refused(
      "turnwright batch lines.jsonl -o mine", 2,
      "mine/results.jsonl: document: got something of no batch: there is no "
      "manifest.json, expected a folder without results.jsonl, summary.json and work, "
      "or one that a batch was begun in\n");
  EXPECT_EQ(contents(folder_ / "mine/results.jsonl"), "mine");
}

TEST_F(Batch, OneRunAtATime) {
  put(folder_ / "lines.jsonl", acceptance(1));
  fs::create_directory(folder_ / "results");
  const auto run = shell("flock results turnwright batch lines.jsonl -o results");
  EXPECT_EQ(run.code, 74);
  EXPECT_EQ(run.err, "results: another run is at work on this batch\n");
  EXPECT_EQ(batch().code, 0);
}

TEST_F(Batch, WithoutAClusterSlurmIsToldToBeMissing) {
  put(folder_ / "lines.jsonl", acceptance(1));
  const auto run = shell(
      "PATH=$(dirname \"$(command -v turnwright)\"):/bin turnwright batch "
      "lines.jsonl -o results --slurm 2> error; code=$?; tail -n 1 error >&2; "
      "exit $code");
  if (fs::exists("/bin/sbatch")) GTEST_SKIP() << "there is an sbatch";
  EXPECT_EQ(run.code, 74);
  EXPECT_NE(run.err.find("/results/work/slurm.sh: sbatch did not take it\n"),
            std::string::npos)
      << run.err;
}

// --- faults

TEST_F(Batch, KilledAtAnyMomentItEndsAsIfUndisturbed) {
  put(folder_ / "lines.jsonl", mixed_lines(50, multipass));
  const auto begun = std::chrono::steady_clock::now();
  const auto whole = undisturbed("--chunk 5");
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begun;

  const int kills = thorough() ? 100 : 5;
  std::mt19937 random(20261122);
  std::uniform_real_distribution<double> moment(0, time.count());
  int killed = 0, finished = 0;
  while (killed < kills) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      if (::chdir(folder_.c_str()) != 0 || !std::freopen("/dev/null", "w", stdout))
        ::_exit(1);
      ::execl(TURNWRIGHT_PROGRAM, "turnwright", "batch", "lines.jsonl", "-o", "results",
              "--chunk", "5", static_cast<char*>(nullptr));
      ::_exit(1);
    }
    std::this_thread::sleep_for(std::chrono::duration<double>(moment(random)));
    ::kill(child, SIGKILL);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    if (WIFSIGNALED(status)) {
      ++killed;
      continue;
    }
    ASSERT_EQ(WEXITSTATUS(status), 0);
    ASSERT_EQ(files_of(folder_ / "results"), whole);
    fs::remove_all(folder_ / "results");
    ++finished;
  }
  EXPECT_EQ(batch("--chunk 5").code, 0);
  EXPECT_EQ(files_of(folder_ / "results"), whole);
  RecordProperty("killed", killed);
  RecordProperty("finished", finished);
}

/// Runs with a fault at every call that touches the disk, one after the other.
class Faults : public Batch, public testing::WithParamInterface<const char*> {};

TEST_P(Faults, AtEveryCallEndInAClearErrorAndTheNextRunGoesOn) {
  if (kSanitized) GTEST_SKIP() << "SKIPPED: the sanitizer wants to be loaded first";
  const std::string fault = GetParam();
  const bool dies = fault == "kill" || fault == "short";
  put(folder_ / "lines.jsonl", mixed_lines(14, acceptance));
  const std::string preload = std::string("LD_PRELOAD=") + TURNWRIGHT_FAULTS + ' ';
  const std::string command =
      "turnwright batch lines.jsonl -o results --chunk 6 --jobs 2";
  EXPECT_EQ(shell(preload + "FAULT_COUNT=count " + command).code, 0);
  const auto whole = files_of(folder_ / "results");
  const long calls = std::stol(contents(folder_ / "count"));
  ASSERT_GT(calls, 40);
  const long step = thorough() ? 1 : 10;
  long tried = 0, told = 0;
  for (long at = thorough() ? 1 : static_cast<long>(fault.size()); at <= calls;
       at += step, ++tried) {
    SCOPED_TRACE(fault + " at " + std::to_string(at));
    fs::remove_all(folder_ / "results");
    const auto run = shell(preload + "FAULT=" + fault +
                           " FAULT_AT=" + std::to_string(at) + ' ' + command);
    if (dies) {
      EXPECT_EQ(run.code, 128 + SIGKILL);
    } else if (run.code != 0) {  // what is left in work/ in the end does no harm
      EXPECT_EQ(run.code, 74);
      const auto why = fault == "full" ? "No space left on device" : "Input/output error";
      EXPECT_NE(run.err.find(std::string("cannot be written: ") + why + '\n'),
                std::string::npos)
          << run.err;
      ++told;
    }
    // A result stands there whole or not at all.
    const auto result = folder_ / "results/results.jsonl";
    if (fs::exists(result)) {
      EXPECT_EQ(contents(result), whole.at("results.jsonl"));
    }
    EXPECT_EQ(shell(command).code, 0);
    EXPECT_EQ(files_of(folder_ / "results"), whole);
  }
  if (!dies) {
    EXPECT_GE(told, tried - 8);
  }
}

INSTANTIATE_TEST_SUITE_P(OfTheDisk, Faults,
                         testing::Values("kill", "short", "full", "broken"),
                         [](const auto& fault) { return std::string(fault.param); });

TEST_F(Batch, AFileThatMayNotGrowIsTold) {
  put(folder_ / "lines.jsonl", mixed_lines(60, multipass));
  const auto whole = undisturbed("--chunk 40");
  const auto run =
      shell("ulimit -f 8; turnwright batch lines.jsonl -o results --chunk 40");
  EXPECT_EQ(run.code, 74);
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err, "results/work/0.jsonl: cannot be written: File too large\n");
  EXPECT_EQ(batch().code, 0);
  EXPECT_EQ(files_of(folder_ / "results"), whole);
}

TEST_F(Batch, AFullDiskIsToldAndSpaceHelps) {
  put(folder_ / "lines.jsonl", mixed_lines(50, multipass));
  const auto whole = undisturbed("--chunk 10");
  const auto run = shell(
      "mkdir results; unshare --mount --map-root-user bash -c '"
      "mount -t tmpfs -o size=100k none results && echo mounted || exit 1;"
      "turnwright batch lines.jsonl -o results --chunk 10; code=$?; ls results;"
      "mount -o remount,size=16m results;"
      "turnwright batch lines.jsonl -o results >&2 && cp -r results copy; exit $code'");
  if (run.out.find("mounted") == std::string::npos)
    GTEST_SKIP() << "SKIPPED: no mount namespace here: " << run.err;
  EXPECT_EQ(run.code, 74);
  EXPECT_EQ(run.out, "mounted\nmanifest.json\nwork\n");
  EXPECT_EQ(run.err.rfind("results/work/", 0), 0U) << run.err;
  EXPECT_NE(run.err.find(".jsonl: cannot be written: No space left on device\n"),
            std::string::npos)
      << run.err;
  EXPECT_EQ(files_of(folder_ / "copy"), whole);
}

TEST_F(Batch, AFolderThatIsReadOnlyIsTold) {
  put(folder_ / "lines.jsonl", mixed_lines(12, acceptance));
  EXPECT_EQ(batch("--shard 1/2 --chunk 4").code, 0);
  const auto before = files_of(folder_ / "results");
  const auto run = shell(
      "unshare --mount --map-root-user bash -c '"
      "mount --bind results results && mount -o remount,ro,bind results && echo mounted "
      "&& turnwright batch lines.jsonl -o results'");
  if (run.out.find("mounted") == std::string::npos)
    GTEST_SKIP() << "SKIPPED: no mount namespace here: " << run.err;
  EXPECT_EQ(run.code, 74);
  EXPECT_EQ(run.err, "results/work/1.jsonl: cannot be written: Read-only file system\n");
  EXPECT_EQ(files_of(folder_ / "results"), before);
  EXPECT_EQ(batch().code, 0);
}

TEST_F(Batch, DamagedChunksAreMadeAnew) {
  put(folder_ / "lines.jsonl", mixed_lines(30, acceptance));
  const auto whole = undisturbed("--chunk 10");
  const auto damage = [&](const std::string& how) {
    fs::remove_all(folder_ / "results");
    EXPECT_EQ(batch("--chunk 10 --shard 1/1").code, 0);
    EXPECT_EQ(shell("cd results/work && " + how).code, 0) << how;
    EXPECT_EQ(batch().code, 0) << how;
    EXPECT_EQ(files_of(folder_ / "results"), whole) << how;
  };
  damage("truncate -s 100 1.jsonl");
  damage("truncate -s -1 1.jsonl");
  damage("truncate -s 0 1.jsonl");
  damage("truncate -s +4096 1.jsonl");
  damage("rm 0.jsonl 2.jsonl");
  damage("cp 1.jsonl 2.jsonl");
  damage("sed -i '1d' 1.jsonl");
  damage("sed -i '2s/true/false/' 1.jsonl");
  damage("sed -i '$s/\"ok\":[0-9]*/\"ok\":3/' 1.jsonl");
  damage("echo '{}' >> 1.jsonl");
  damage("head -c 5000 /dev/urandom > 1.jsonl");
  damage("rm 1.jsonl && mkdir 1.jsonl && rmdir 1.jsonl");
}

TEST_F(Batch, ADamagedResultIsTold) {
  put(folder_ / "lines.jsonl", mixed_lines(12, acceptance));
  const auto whole = undisturbed("--chunk 4");
  EXPECT_EQ(batch("--chunk 4").code, 0);
  EXPECT_EQ(shell("truncate -s -10 results/results.jsonl").code, 0);
  const auto run = batch();
  EXPECT_EQ(run.code, 2);
  EXPECT_EQ(run.err.rfind("results/results.jsonl: document: got ", 0), 0U) << run.err;
  EXPECT_NE(run.err.find(", as this batch wrote it; without the file it is made anew\n"),
            std::string::npos)
      << run.err;
  fs::remove(folder_ / "results/results.jsonl");
  EXPECT_EQ(batch().code, 0);
  EXPECT_EQ(files_of(folder_ / "results"), whole);
}

TEST_F(Batch, ADamagedManifestOrSummaryIsToldAndCanBeRemoved) {
  put(folder_ / "lines.jsonl", mixed_lines(12, acceptance));
  const auto whole = undisturbed("--chunk 100");
  for (const std::string file : {"manifest.json", "summary.json"}) {
    for (const std::string how :
         {"truncate -s 20 ", "truncate -s 0 ", "sed -i 's/turnwright-batch/else/' ",
          "sed -i 's/: *[0-9][0-9]*/: -1/' ", "sed -i 's/sha256/sha1/' "}) {
      SCOPED_TRACE(how + file);
      fs::remove_all(folder_ / "results");
      // With its manifest alone, a batch is not complete.
      EXPECT_EQ(batch(file == "manifest.json" ? "--shard 1/1" : "").code, 0);
      const auto damaged = folder_ / "results" / file;
      EXPECT_EQ(shell(how + "results/" + file).code, 0);
      const auto before = contents(damaged);
      const auto run = batch();
      EXPECT_EQ(run.code, 2);
      EXPECT_EQ(run.err.rfind("results/" + file + ": ", 0), 0U) << run.err;
      EXPECT_EQ(contents(damaged), before);
      fs::remove(damaged);
      if (file == "manifest.json") fs::remove_all(folder_ / "results/work");
      EXPECT_EQ(batch().code, 0);
      EXPECT_EQ(files_of(folder_ / "results"), whole);
    }
  }
}

TEST_F(Batch, ClocksDoNotMatter) {
  if (kSanitized) GTEST_SKIP() << "SKIPPED: the sanitizer wants to be loaded first";
  if (shell("command -v faketime").code != 0) GTEST_SKIP() << "SKIPPED: no faketime";
  put(folder_ / "lines.jsonl", mixed_lines(20, multipass));
  const auto whole = undisturbed("--chunk 7");
  // Days before, days after, and a clock that runs a thousand times as fast.
  for (const std::string clock : {"-f '-400d'", "-f '+400d'", "-f '+0 x1000'"}) {
    fs::remove_all(folder_ / "results");
    EXPECT_EQ(batch("--chunk 7 --shard 1/2").code, 0);
    const auto run =
        shell("faketime " + clock + " turnwright batch lines.jsonl -o results");
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(files_of(folder_ / "results"), whole) << clock;
  }
}

}  // namespace
}  // namespace turnwright::app
