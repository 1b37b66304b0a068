#include "service/batch/job_store.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "../../temporary_folder.hpp"
#include "../little_memory.hpp"
#include "service/batch/batches.hpp"
#include "service/batch/fatal_lines.hpp"
#include "service/batch/line.hpp"
#include "service/batch/spool.hpp"
#include "turnwright/base/cancelled.hpp"

namespace turnwright::service::job_store_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class JobStoreTest : public TemporaryFolder {
 protected:
  fs::path file() const { return folder_ / "jobs.sqlite"; }
};

JobStore::Record record(const JobStore::Line& line, std::string text) {
  return {line.job, line.number, "", std::move(text), false};
}

TEST_F(JobStoreTest, LinesAreTakenOnceInOrderOldestJobFirst) {
  JobStore store(file(), "data");
  const auto first = *store.submit("a\n\nb");
  const auto second = *store.submit("c\n");
  const auto lines = store.take(2);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].text + lines[1].text, "ab");
  EXPECT_EQ(lines[1].number, 3);  // the number in the sender's file
  const auto rest = store.take(9);
  ASSERT_EQ(rest.size(), 1U);
  EXPECT_EQ(rest[0].job, second);
  EXPECT_TRUE(store.take(9).empty());
  store.submit("d");
  store.submit("e\nf");
  EXPECT_EQ(store.take(2).size(), 2U);  // of both
  EXPECT_EQ(store.take(2).size(), 1U);
  EXPECT_EQ(store.job(first)->lines, 3);
  EXPECT_EQ(store.job(first)->done, 1);  // the blank one
}

TEST_F(JobStoreTest, TooManyLinesAreNoJobAndEmptyOnesAreNone) {
  JobStore store(file(), "data");
  std::string lines;
  for (std::size_t i = 0; i <= JobStore::kMostLines; ++i) lines += "0\n";
  EXPECT_FALSE(store.submit(lines));
  EXPECT_TRUE(store.jobs().empty());
  EXPECT_TRUE(store.submit(std::string(2 * JobStore::kMostLines, '\n') + "a"));
  EXPECT_EQ(store.take(9).at(0).number,
            static_cast<std::int64_t>(2 * JobStore::kMostLines + 1));
}

TEST_F(JobStoreTest, LinesComeFromAFileAsFromMemory) {
  JobStore store(file(), "data");
  const auto spool = store.spool();
  spool->write("a\n\nb");
  auto lines = spool->lines();
  const auto next = [&lines](std::string& line) { return lines.next(line); };
  const auto id = *store.submit(next);
  EXPECT_EQ(store.job(id)->lines, 3);
  EXPECT_EQ(store.job(id)->done, 1);
  const auto taken = store.take(9);
  ASSERT_EQ(taken.size(), 2U);
  EXPECT_EQ(taken[0].text + taken[1].text, "ab");
  EXPECT_EQ(taken[1].number, 3);
  // Of a batch with too many lines nothing is kept.
  std::size_t given = 0;
  EXPECT_FALSE(store.submit([&given](std::string& line) {
    line = "0";
    return ++given <= JobStore::kMostLines + 1;
  }));
  EXPECT_TRUE(store.take(9).empty());
}

TEST_F(JobStoreTest, ResultsStopWhereOneIsMissing) {
  JobStore store(file(), "data");
  const auto id = *store.submit("a\nb\nc");
  const auto lines = store.take(3);
  store.finish(
      std::vector{record(lines[0], R"({"x":1})"), record(lines[2], R"({"x":3})")});
  EXPECT_EQ(store.results(id, 1, 1000).jsonl, "{\"line\":1,\"x\":1}\n");
  EXPECT_EQ(store.results(id, 1, 1000).next, 2);
  EXPECT_EQ(store.job(id)->state, "running");
  store.finish(std::vector{record(lines[1], R"({"x":2})")});
  EXPECT_EQ(store.job(id)->state, "done");
  EXPECT_EQ(store.results(id, 2, 1000).jsonl,
            "{\"line\":2,\"x\":2}\n{\"line\":3,\"x\":3}\n");
  EXPECT_EQ(store.results(id, 1, 1).next, 2);  // a page holds at least one line
}

TEST_F(JobStoreTest, WhatWasTakenAndNotFinishedIsTakenAgainAfterARestart) {
  {
    JobStore store(file(), "data");
    store.submit("a\nb\nc");
    const auto lines = store.take(2);
    store.finish(std::vector{record(lines[0], "{}")});
  }
  JobStore store(file(), "data");
  const auto lines = store.take(9);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].text + lines[1].text, "bc");
  EXPECT_EQ(store.job(1)->done, 1);
}

TEST_F(JobStoreTest, ARecordOnceStoredStays) {
  JobStore store(file(), "data");
  const auto id = *store.submit("a");
  const auto lines = store.take(1);
  store.finish(
      std::vector{record(lines[0], R"({"x":1})"), record(lines[0], R"({"x":2})")});
  EXPECT_EQ(store.results(id, 1, 1000).jsonl, "{\"line\":1,\"x\":1}\n");
  EXPECT_EQ(store.job(id)->done, 1);
}

TEST_F(JobStoreTest, CancelledLinesAreLeftAndRemovedJobsForgotten) {
  JobStore store(file(), "data");
  const auto id = *store.submit("a\nb\n");
  const auto lines = store.take(1);
  EXPECT_TRUE(store.cancel(id));
  EXPECT_TRUE(store.take(9).empty());
  store.finish(std::vector{record(lines[0], "{}")});
  EXPECT_EQ(store.job(id)->state, "cancelled");
  EXPECT_EQ(store.job(id)->done, 1);
  EXPECT_TRUE(store.remove(id));
  EXPECT_FALSE(store.job(id));
  EXPECT_FALSE(store.remove(id));
  EXPECT_FALSE(store.cancel(id));
  store.finish(std::vector{record(lines[0], "{}")});  // too late: no harm
  EXPECT_TRUE(store.jobs().empty());
}

TEST_F(JobStoreTest, ACancelledJobWhoseLastLineWasUnderWayStaysCancelled) {
  JobStore store(file(), "data");
  const auto id = *store.submit("a");
  const auto line = store.take(1).at(0);
  EXPECT_TRUE(store.cancel(id));
  store.finish(std::vector{record(line, "{}")});
  EXPECT_EQ(store.job(id)->state, "cancelled");
  EXPECT_EQ(store.job(id)->done, 1);
}

TEST_F(JobStoreTest, OfARemovedJobNothingIsKept) {
  {
    JobStore store(file(), "data");
    store.remove(*store.submit("a\nb"));
  }
  SQLite::Database database(file().string());
  EXPECT_EQ(database.execAndGet("SELECT count(*) FROM line").getInt(), 0);
}

TEST_F(JobStoreTest, OneProcessAtATimeAndOnlyJobStores) {
  JobStore store(file(), "data");
  EXPECT_THROW(JobStore(file(), "data"), std::runtime_error);
  std::ofstream(folder_ / "text") << std::string(4096, 'x');
  EXPECT_THROW(JobStore(folder_ / "text", "data"), std::runtime_error);
  EXPECT_THROW(JobStore(folder_ / "missing" / "jobs.sqlite", "data"), std::runtime_error);
}

TEST_F(JobStoreTest, RecordsOfOtherDataAreNotMixed) {
  std::int64_t begun = 0, fresh = 0, done = 0;
  {
    JobStore store(file(), "old");
    begun = *store.submit("a\nb\n");
    auto records = std::vector{record(store.take(1)[0], R"({"x":"old"})")};
    records[0].digest = "d";
    store.finish(records);
    EXPECT_TRUE(store.known("d"));
    done = *store.submit("\n \n");
    fresh = *store.submit("\nc\n");
  }
  {
    JobStore store(file(), "new");
    EXPECT_FALSE(store.known("d"));
    EXPECT_EQ(store.job(begun)->state, "outdated");
    EXPECT_EQ(store.job(begun)->done, 1);
    EXPECT_EQ(store.results(begun, 1, 1000).jsonl, "{\"line\":1,\"x\":\"old\"}\n");
    EXPECT_EQ(store.job(done)->state, "done");
    EXPECT_EQ(store.job(fresh)->state, "running");
    const auto lines = store.take(9);  // nothing of the first
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines[0].text, "c");
    auto records = std::vector{record(lines[0], R"({"x":"new"})")};
    records[0].digest = "d";
    store.finish(records);
    EXPECT_EQ(store.known("d"), R"({"x":"new"})");
    EXPECT_TRUE(store.cancel(begun));
    EXPECT_EQ(store.job(begun)->state, "outdated");
  }
  JobStore store(file(), "old");  // as it was: still not gone on with
  EXPECT_EQ(store.job(begun)->state, "outdated");
  EXPECT_EQ(store.known("d"), R"({"x":"old"})");
  EXPECT_TRUE(store.take(9).empty());
}

TEST_F(JobStoreTest, ASubmissionThatIsLeftStoresNothing) {
  JobStore store(file(), "data");
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(store.submit("a\nb\n", stop.get_token()), Cancelled);
  EXPECT_TRUE(store.jobs().empty());
  EXPECT_TRUE(store.take(9).empty());
  EXPECT_EQ(store.submit("a\n"), 1);
}

TEST_F(JobStoreTest, BlankLinesCountAndAreDone) {
  JobStore store(file(), "data");
  const auto id = *store.submit("\na\n \t\r\n\nb");
  EXPECT_EQ(store.job(id)->lines, 5);
  EXPECT_EQ(store.job(id)->done, 3);
  const auto lines = store.take(9);
  EXPECT_EQ(lines.at(0).number, 2);
  EXPECT_EQ(lines.at(1).number, 5);
  store.finish(std::vector{record(lines[0], "{}"), record(lines[1], "{}")});
  EXPECT_EQ(store.job(id)->done, 5);
  EXPECT_EQ(store.job(id)->state, "done");
  const auto blank = *store.submit("\n\n");
  EXPECT_EQ(store.job(blank)->state, "done");
  EXPECT_EQ(store.job(blank)->lines, 2);
  const auto none = *store.submit("");
  EXPECT_EQ(store.job(none)->state, "done");
  EXPECT_EQ(store.job(none)->lines, 0);
}

TEST_F(JobStoreTest, ADatabaseOfAnotherProgramIsLeftAlone) {
  {
    SQLite::Database other(file().string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    other.exec("CREATE TABLE job (mine TEXT)");
  }
  const auto bytes = [this] {
    std::ifstream in(file(), std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(in), {}};
  };
  const auto before = bytes();
  const auto refusal = [this]() -> std::string {
    try {
      const JobStore store(file(), "data");
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal(), file().string() + ": a database of another program");
  EXPECT_EQ(bytes(), before);
  fs::remove(file());
  { const JobStore store(file(), "data"); }
  {
    SQLite::Database older(file().string(), SQLite::OPEN_READWRITE);
    older.exec("PRAGMA user_version = 1");
  }
  EXPECT_EQ(refusal(),
            file().string() +
                ": a job store of version 1, but this program reads only version 2");
}

// Ends in an overflow of the stack long before that of the depth.
int out_of_stack(int depth) {
  volatile char frame[1000];
  frame[0] = 1;
  return depth < 0 ? 0 : out_of_stack(depth + 1) + frame[0];
}

TEST_F(JobStoreTest, ALineThatEndsTheProcessIsAnErrorOfTheNextOne) {
  JobStore(file(), "data").submit("a\nb\nc\n");
  const auto die = [this](void (*fault)(), bool cancelled = false) {
    const pid_t child = ::fork();
    if (child == 0) {
      JobStore store(file(), "data");
      const auto line = store.take(1)[0];
      if (cancelled) store.cancel(line.job);
      const FatalLines lines(store.fatal_file());
      const FatalLines::Computing computing({line.job, line.number});
      fault();
      ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_NE(status, 0);
  };
  const auto next = [this] { return JobStore(file(), "data").take(1).at(0).text; };
  die([] { out_of_stack(0); });
  EXPECT_EQ(next(), "b");
  die([] { std::abort(); });
  EXPECT_EQ(next(), "c");
  // What another thread or somebody else does says nothing about the line.
  die([] { std::thread(std::abort).join(); });
  EXPECT_EQ(next(), "c");
  die([] { ::kill(::getpid(), SIGABRT); });
  EXPECT_EQ(next(), "c");
  die([] { ::kill(::getpid(), SIGKILL); });
  EXPECT_EQ(next(), "c");
  die([] { std::abort(); }, true);  // nobody waits for it
  const JobStore store(file(), "data");
  EXPECT_EQ(store.job(1)->errors, 2);
  EXPECT_EQ(store.job(1)->done, 2);
  EXPECT_FALSE(fs::exists(store.fatal_file()));
  EXPECT_EQ(store.results(1, 1, 1).jsonl,
            "{\"line\":1,\"status\":\"error\",\"title\":\"internal error\","
            "\"detail\":\"the process ended while this line was computed\"}\n");
}

// A line that there is no memory for is an error; the others are answered.
TEST_F(JobStoreTest, ALineWithoutMemoryIsARecord) {
  const auto catalogue = document::load_catalogue(TURNWRIGHT_SOURCE_DIR);
  JobStore store(file(), "data");
  const std::string good = R"({"name": "multipass", "document": {"dt_mm": 8}})";
  std::string large = R"({"name": "multipass", "document": {"dt_mm": [0)";
  for (int i = 0; i < 20'000; ++i) large += ",0";
  large += "]}}";
  const auto id = *store.submit(good + '\n' + large + '\n' + good + '\n');
  {
    const LittleMemory little(100'000);
    Batches batches(store, catalogue, 2);
    while (store.job(id)->state == "running")
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_EQ(store.job(id)->errors, 1);
  const auto results = store.results(id, 2, 1).jsonl;
  EXPECT_EQ(results,
            "{\"line\":2,\"status\":\"error\",\"title\":\"internal error\","
            "\"detail\":\"not enough memory\"}\n");
  // With memory it is a request like others: nothing of the shortage is kept.
  const auto again = *store.submit(large + '\n');
  {
    Batches batches(store, catalogue, 1);
    while (store.job(again)->state == "running")
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_NE(store.results(again, 1, 1).jsonl.find("/dt_mm"), std::string::npos);
}

TEST_F(JobStoreTest, BatchesAnswerEveryLineAndEqualOnesAlike) {
  const auto catalogue = document::load_catalogue(TURNWRIGHT_SOURCE_DIR);
  JobStore store(file(), "data");
  const std::string good = R"({"name": "multipass", "document": {"dt_mm": 8}})";
  std::vector<std::string> lines(40, good);
  lines[3] = "no json";
  lines[4] = R"({"name": "multipas", "document": {}})";
  lines[5] = R"({"name": "multipass", "document": {"dt_mm": "8"}})";
  lines[6] = R"({"name": "multipass", "document": {"dt_mm": 100}})";
  std::string text;
  for (const auto& line : lines) text += line + '\n';
  const auto id = *store.submit(text);
  {
    Batches batches(store, catalogue, 2);
    while (store.job(id)->state == "running")
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_EQ(store.job(id)->errors, 3);
  std::istringstream results(store.results(id, 1, 100'000'000).jsonl);
  std::vector<json> all;
  for (std::string line; std::getline(results, line);) all.push_back(json::parse(line));
  ASSERT_EQ(all.size(), lines.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].at("line"), i + 1);
    EXPECT_EQ(all[i].at("status"), i >= 3 && i <= 5 ? "error"
                                   : i == 6         ? "infeasible"
                                                    : "ok");
  }
  EXPECT_EQ(all[0].at("result"), all[39].at("result"));
  EXPECT_EQ(all[4].at("errors").at(0).at("pointer"), "/name");
  EXPECT_EQ(all[5].at("errors").at(0).at("pointer"), "/dt_mm");
}

/// A line that is computed for minutes.
std::string long_line() {
  const json cut = json::parse(R"({
    "model": "milling", "teeth": 3, "Kt_MPa": 700, "Kn_MPa": 250, "direction": "up",
    "radial_immersion": 0.4, "diameter_mm": 12, "helix_deg": 35,
    "pitch_deg": [110, 121, 129], "modes": [
      {"axis": "x", "frequency_Hz": 900, "damping_ratio": 0.02, "stiffness_N_mm": 9000},
      {"axis": "y", "frequency_Hz": 1100, "damping_ratio": 0.02, "stiffness_N_mm": 9000}],
    "ap_max_mm": 4, "speeds_rpm": {"from": 3000, "to": 6000, "count": 500}})");
  return json{{"name", "stability"}, {"document", cut}}.dump() + '\n';
}

TEST_F(JobStoreTest, ALineUnderWayEndsWithItsJob) {
  using namespace std::chrono_literals;
  const auto catalogue = document::load_catalogue(TURNWRIGHT_SOURCE_DIR);
  JobStore store(file(), "data");
  const std::string good = R"({"name": "multipass", "document": {"dt_mm": 8}})";
  const auto cancelled = *store.submit(good + '\n' + long_line() + good);
  const auto removed = *store.submit(long_line());
  const auto last = *store.submit(good);
  Batches batches(store, catalogue, 1);
  std::this_thread::sleep_for(200ms);
  EXPECT_TRUE(batches.cancel(cancelled));
  std::this_thread::sleep_for(200ms);
  EXPECT_TRUE(batches.remove(removed));
  EXPECT_FALSE(batches.remove(removed));
  for (int i = 0; i < 1000 && store.job(last)->state == "running"; ++i)
    std::this_thread::sleep_for(10ms);
  EXPECT_EQ(store.job(last)->state, "done");
  EXPECT_EQ(store.job(cancelled)->state, "cancelled");
  EXPECT_LE(store.job(cancelled)->done, 1);  // no record of what was stopped
  EXPECT_EQ(store.job(cancelled)->errors, 0);
}

// A small job too is shared, and its cancel leaves what has not begun.
TEST_F(JobStoreTest, WorkersTakeALineAtATime) {
  const auto catalogue = document::load_catalogue(TURNWRIGHT_SOURCE_DIR);
  JobStore store(file(), "data");
  constexpr int kLines = 400;  // many times those that share a write
  std::string text;
  for (int i = 0; i < kLines; ++i) {
    const json cut{{"model", "milling"},
                   {"teeth", 2},
                   {"Kt_MPa", 600},
                   {"Kn_MPa", 200},
                   {"radial_immersion", 0.5},
                   {"direction", "down"},
                   {"modes",
                    {{{"axis", "x"},
                      {"frequency_Hz", 500 + i},
                      {"damping_ratio", 0.02},
                      {"stiffness_N_mm", 5000}}}},
                   {"ap_max_mm", 2},
                   {"speeds_rpm", {{"from", 3000}, {"to", 9000}, {"count", 200}}}};
    text += json{{"name", "stability"}, {"document", cut}}.dump() + '\n';
  }
  const auto id = *store.submit(text);
  {
    Batches batches(store, catalogue, 1);
    while (store.job(id)->done == 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_TRUE(store.cancel(id));
    EXPECT_TRUE(store.take(1).empty());
  }
  EXPECT_EQ(store.job(id)->errors, 0);
  EXPECT_LT(store.job(id)->done, kLines);
}

}  // namespace
}  // namespace turnwright::service::job_store_test
