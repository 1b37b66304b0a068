#include "command_line.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <utility>
#include <vector>

namespace turnwright::app {
namespace {

std::size_t lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// What the manuals show behind "$ ": a command, with the lines up to END where it reads
/// such, and what it prints.
struct Shown {
  std::string command, output;
};

std::vector<Shown> shown_in(const fs::path& manual) {
  std::vector<Shown> all;
  std::ifstream in(manual);
  bool inside = false, command = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("```")) {
      inside = line == "```console";
    } else if (inside && line.starts_with("$ ")) {
      all.push_back({line.substr(2), ""});
      command = line.ends_with("<<END");
    } else if (inside && command) {
      all.back().command += '\n' + line;
      command = line != "END";
    } else if (inside && !line.starts_with("made by ")) {
      all.back().output += line + '\n';
    }
  }
  return all;
}

TEST_F(CommandLine, PrintsWhatTheManualsShow) {
  int checked = 0;
  for (const auto& file :
       fs::directory_iterator(fs::path(TURNWRIGHT_SOURCE_DIR) / "docs"))
    for (const auto& [command, output] : shown_in(file.path())) {
      const auto run = shell(command);
      EXPECT_EQ(run.code, 0) << command << run.err;
      const auto made_by = run.out.find("made by ");
      const auto rest = run.out.find('\n', made_by) + 1;
      EXPECT_EQ(run.out.substr(0, made_by) + run.out.substr(rest), output) << command;
      ++checked;
    }
  EXPECT_GE(checked, 1);
}

TEST_F(CommandLine, TellsItsVersion) {
  const auto outcome = shell("turnwright --version");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out, std::string(service::version()) + '\n');
}

TEST_F(CommandLine, EveryHelpShowsExamplesThatRun) {
  std::vector<std::string> helps{"turnwright --help", "turnwright list --help",
                                 "turnwright new --help"};
  for (const auto& row : service::requests())
    helps.push_back("turnwright " + row.name + " --help");
  for (const auto& help : helps) {
    SCOPED_TRACE(help);
    const auto outcome = shell(help);
    EXPECT_EQ(outcome.code, 0);
    const auto at = outcome.out.find("Example");
    ASSERT_NE(at, std::string::npos);
    const auto examples = outcome.out.substr(outcome.out.find('\n', at));
    ASSERT_NE(examples.find("turnwright "), std::string::npos);
    const auto run = shell("set -e" + examples, TURNWRIGHT_SOURCE_DIR);
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_NE(run.out, "");
    EXPECT_EQ(run.err, "");
  }
}

TEST_F(CommandLine, RefusesWhatItDoesNotKnowOnStandardError) {
  for (const std::string wrong :
       {"turnwright plane part.json", "turnwright list nuts", "turnwright acceptance",
        "turnwright acceptance - --fast < /dev/null"}) {
    SCOPED_TRACE(wrong);
    const auto outcome = shell(wrong);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err, "");
  }
}

TEST_F(CommandLine, NamesAnUnknownCommandAndTheNearest) {
  EXPECT_EQ(shell("turnwright plane part.json").err,
            "command line: COMMAND: got \"plane\", expected a command (did you mean "
            "\"plan\"?)\n");
  const auto strange = shell("turnwright --data . quadrature");
  EXPECT_EQ(strange.code, 2);
  EXPECT_EQ(strange.err,
            "command line: COMMAND: got \"quadrature\", expected a command; turnwright "
            "--help names all\n");
}

TEST_F(CommandLine, ListsWhatRequestsMayReferTo) {
  EXPECT_NE(shell("turnwright list materials").out.find("\nC45 "), std::string::npos);
  EXPECT_NE(shell("turnwright list machines").out.find("lathe-medium "),
            std::string::npos);
  EXPECT_NE(shell("turnwright list parts").out.find("gearbox-input-shaft "),
            std::string::npos);
  EXPECT_NE(shell("turnwright list tools").out.find("CNMG120408"), std::string::npos);
}

TEST_F(CommandLine, AloneShowsItsHelpAndItsLists) {
  const auto alone = shell("turnwright");
  EXPECT_EQ(alone.code, 0);
  EXPECT_EQ(alone.out, shell("turnwright --help").out);
  const auto lists = shell("turnwright list");
  EXPECT_EQ(lists.code, 0);
  EXPECT_EQ(lists.out.substr(0, lists.out.find('\n')), "turnwright list materials");
}

TEST_F(CommandLine, AFirstPartIsPlannedAndNotWrittenOverAnother) {
  const auto file = (folder_ / "first.json").string();
  EXPECT_EQ(shell("turnwright new -o '" + file + "'").code, 0);
  const auto part = nlohmann::json::parse(contents(file));
  EXPECT_TRUE(fs::exists(part["$schema"].get<std::string>())) << part["$schema"];
  EXPECT_EQ(shell("turnwright plan '" + file + "'").code, 0);
  const auto again = shell("turnwright new -o '" + file + "'");
  EXPECT_EQ(again.code, 2);
  EXPECT_NE(again.err.find("a file that is not there yet"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(shell("turnwright new").out), part);
}

TEST_F(CommandLine, SaysWhichDataFolderIsNone) {
  const auto outcome = shell("turnwright --data elsewhere list materials");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("elsewhere"), std::string::npos);
}

TEST_F(CommandLine, FileAndStandardInputGiveTheSameBytes) {
  for (const auto& row : service::requests()) {
    SCOPED_TRACE(row.name);
    put(folder_ / "request.json", row.example);
    const auto file = shell("turnwright " + row.name + " request.json --json");
    const auto stdin_ = shell("turnwright " + row.name + " - --json < request.json");
    EXPECT_EQ(file.code, 0) << file.err;
    EXPECT_EQ(file.out, stdin_.out);
    EXPECT_EQ(nlohmann::json::parse(file.out).at("turnwright_version"),
              service::version());
  }
}

TEST_F(CommandLine, OutputFileIsReplacedByTheWholeResult) {
  put(folder_ / "request.json", row("acceptance").example);
  put(folder_ / "result.json", "old");
  fs::create_symlink("result.json", folder_ / "link.json");
  const auto printed = shell("turnwright acceptance request.json").out;
  const auto outcome = shell("turnwright acceptance request.json -o link.json");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(contents(folder_ / "result.json"), printed);
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.json"));
  EXPECT_EQ(files(),
            (std::vector<std::string>{"link.json", "request.json", "result.json"}));
}

// A pipe stands for every special file: a test run by root must not be able to harm /dev.
TEST_F(CommandLine, SpecialFilesAreWrittenNotReplaced) {
  put(folder_ / "request.json", row("acceptance").example);
  const auto printed = shell("turnwright acceptance request.json").out;
  const auto outcome = shell(
      "mkfifo pipe; timeout 200 cat pipe & "
      "timeout 200 turnwright acceptance request.json -o pipe; code=$?; wait; exit "
      "$code");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out, printed);
  EXPECT_TRUE(fs::is_fifo(folder_ / "pipe"));
}

TEST_F(CommandLine, AFailedRequestLeavesTheOldResult) {
  put(folder_ / "request.json", "{}");
  put(folder_ / "result.json", "old");
  EXPECT_EQ(shell("turnwright acceptance request.json -o result.json").code, 2);
  EXPECT_EQ(contents(folder_ / "result.json"), "old");
  EXPECT_EQ(files(), (std::vector<std::string>{"request.json", "result.json"}));
}

TEST_F(CommandLine, AFullDiskLeavesTheOldResult) {
  auto request = nlohmann::json::parse(row("acceptance").example);
  for (int i = 0; i < 50; ++i) request["cases"].push_back(request["cases"][1]);
  for (std::size_t i = 0; i < request["cases"].size(); ++i)
    request["cases"][i]["id"] = std::to_string(i);
  put(folder_ / "request.json", request.dump());
  put(folder_ / "result.json", "old");
  const auto outcome =
      shell("ulimit -f 1; turnwright acceptance request.json -o result.json");
  EXPECT_EQ(outcome.code, 74);
  EXPECT_EQ(outcome.err.rfind("result.json: cannot be written: ", 0), 0u) << outcome.err;
  EXPECT_EQ(contents(folder_ / "result.json"), "old");
  EXPECT_EQ(files(), (std::vector<std::string>{"request.json", "result.json"}));
}

TEST_F(CommandLine, EachProblemHasALineWithItsPlace) {
  auto request = nlohmann::json::parse(row("acceptance").example);
  request["cases"][0]["upper_mm"] = "0.016";
  request["cases"][1]["value_mm"] = -1;
  request["colour"] = "red";
  put(folder_ / "request.json", request.dump());
  const auto outcome = shell("turnwright acceptance request.json");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(lines(outcome.err), 3u) << outcome.err;
  for (const std::string place : {"/cases/0/upper_mm", "/cases/1/value_mm", "/colour"})
    EXPECT_NE(outcome.err.find(place), std::string::npos) << outcome.err;
}

// Names come from elsewhere: what a terminal would obey is shown instead, and JSON means
// the same as before.
TEST_F(CommandLine, ControlCharactersOfNamesAreShownNotObeyed) {
  auto part =
      nlohmann::json::parse(contents(TURNWRIGHT_SOURCE_DIR "/parts/pump-shaft.json"));
  const std::string name =
      "Shaft\x1b[31m\x7f\xc2\x9b"
      "31m \u00d820";
  part["name"] = name;
  put(folder_ / "part.json", part.dump());
  for (const char* how : {"", " --json", " --report report.html"}) {
    const auto run = shell("turnwright plan part.json -o plan.json" + std::string(how));
    ASSERT_EQ(run.code, 0) << run.err;
    for (const char* control : {"\x1b", "\x7f", "\xc2\x9b"}) {
      EXPECT_EQ(run.out.find(control), std::string::npos) << how;
      EXPECT_EQ(run.err.find(control), std::string::npos) << how;
    }
    EXPECT_NE(run.out.find("\\u009b31m \u00d820"), std::string::npos)
        << how << run.out.substr(0, 300);
  }
  const auto printed = shell("turnwright drawing part.json").out;
  EXPECT_EQ(nlohmann::json::parse(printed).at("name"), name);
  const auto page = contents(folder_ / "report.html");
  for (const char* control : {"\x1b", "\x7f", "\xc2\x9b"})
    EXPECT_EQ(page.find(control), std::string::npos);
  const auto file = shell("turnwright plan \"$(printf 'no\\033[31mfile')\"");
  EXPECT_EQ(file.code, 2);
  EXPECT_NE(file.err.find("no\\u001b[31mfile"), std::string::npos) << file.err;
}

TEST_F(CommandLine, FilesThatAreNoDocumentsAreNamed) {
  put(folder_ / "cut.json", "{\"shaft\": ");
  put(folder_ / "twice.json", "{\"shaft\": 1, \"shaft\": 2}");
  for (const std::string file : {"missing.json", "cut.json", "twice.json", "."}) {
    SCOPED_TRACE(file);
    const auto outcome = shell("turnwright acceptance " + file);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err.rfind(file + ':', 0), 0u) << outcome.err;
  }
  EXPECT_EQ(shell("turnwright acceptance - < /dev/null").err.rfind("standard input:", 0),
            0u);
  for (const auto& [from, why] :
       {std::pair{"< .", "Is a directory"}, std::pair{"<&-", "Bad file descriptor"}}) {
    const auto outcome = shell(std::string("turnwright acceptance - ") + from);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.err, std::string("standard input: document: got nothing: it cannot "
                                       "be read: ") +
                               why + ", expected a JSON document\n");
  }
}

TEST_F(CommandLine, TwoOutputsHaveTwoPlaces) {
  put(folder_ / "request.json", row("plan").example);
  put(folder_ / "one", "old");
  fs::create_symlink("one", folder_ / "link");
  for (const auto& [outputs, told] :
       {std::pair{"--report one -o one", "--report"},
        std::pair{"-o one --report ./link", "--report"},
        std::pair{"-o none --report \"$PWD/none\"", "--report"},
        std::pair{"-o one --drawings one", "--drawings"},
        std::pair{"--report one --nc one", "--nc"},
        std::pair{"-o new/setup-1.svg --drawings new/", "--drawings"},
        std::pair{"--report new/tools.tbl --nc new", "--nc"}}) {
    SCOPED_TRACE(outputs);
    const auto outcome = shell(std::string("turnwright plan request.json ") + outputs);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.err.rfind(std::string("command line: ") + told + ": got ", 0), 0U)
        << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }
  EXPECT_EQ(files(), (std::vector<std::string>{"link", "one", "request.json"}));
  EXPECT_EQ(contents(folder_ / "one"), "old");
  EXPECT_EQ(shell("mkdir new && turnwright plan request.json -o new/plan.json --report "
                  "/dev/null --drawings new --nc new")
                .code,
            0);
}

TEST_F(CommandLine, DrawingsAreWrittenOneASetupAndOneOfTheBudget) {
  for (const std::string name : {"plan", "predict"}) {
    SCOPED_TRACE(name);
    put(folder_ / "request.json", row(name).example);
    const std::string command = "turnwright " + name + " request.json --json";
    const auto outcome = shell(command + " --drawings new/" + name);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, shell(command).out);
    for (const std::string setup : {"1", "2"}) {
      const auto svg = contents(folder_ / "new" / name / ("setup-" + setup + ".svg"));
      EXPECT_EQ(svg.rfind("<svg ", 0), 0u);
      EXPECT_NE(svg.find("Setup " + setup + ": chuck"), std::string::npos);
    }
    EXPECT_FALSE(fs::exists(folder_ / "new" / name / "setup-3.svg"));
    EXPECT_NE(contents(folder_ / "new" / name / "budget.svg").find("d2:diameter"),
              std::string::npos);
    const auto window = folder_ / "new" / name / "window-s1-face-right.svg";
    EXPECT_EQ(fs::exists(window), name == "plan");
    if (name == "plan") {
      EXPECT_NE(contents(window).find("window of speed and feed"), std::string::npos);
      EXPECT_NE(contents(window).find("cost +5 %"), std::string::npos);
    }
  }
}

TEST_F(CommandLine, AReportIsOneFile) {
  for (const std::string name : {"plan", "predict"}) {
    SCOPED_TRACE(name);
    put(folder_ / "request.json", row(name).example);
    const std::string command = "turnwright " + name + " request.json";
    const auto outcome = shell(command + " --report report.html");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, shell(command).out);
    const auto page = contents(folder_ / "report.html");
    EXPECT_EQ(page.rfind("<!doctype html>", 0), 0u);
    EXPECT_NE(page.find("<h1>Pin</h1>"), std::string::npos);
    EXPECT_NE(page.find("data:image/svg+xml,"), std::string::npos);
  }
  EXPECT_EQ(shell("turnwright plan request.json --report none/report.html").code, 74);
}

TEST_F(CommandLine, StabilityHasAChartAndAReport) {
  put(folder_ / "request.json", row("stability").example);
  const auto outcome =
      shell("turnwright stability request.json --drawings new --report report.html");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");  // no progress where nobody looks
  EXPECT_EQ(contents(folder_ / "new" / "stability.svg").rfind("<svg ", 0), 0u);
  EXPECT_NE(contents(folder_ / "report.html").find("<h1>Stability of the cut</h1>"),
            std::string::npos);
}

// script(1) gives the program a terminal.
TEST_F(CommandLine, ALongSweepIsToldOnATerminal) {
  if (std::system("script --version > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "script is not there";
  put(folder_ / "sweep.json", R"({
    "model": "milling", "teeth": 2, "Kt_MPa": 600, "Kn_MPa": 200, "direction": "slot",
    "modes": [
      {"axis": "x", "frequency_Hz": 922, "damping_ratio": 0.011, "mass_kg": 0.03993},
      {"axis": "y", "frequency_Hz": 922, "damping_ratio": 0.011, "mass_kg": 0.03993}],
    "ap_max_mm": 0.3, "speeds_rpm": {"from": 5000, "to": 25000, "count": 6000}})");
  const auto outcome =
      shell("script -qec 'turnwright stability sweep.json -o result.json' typed");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(
      std::regex_search(contents(folder_ / "typed"),
                        std::regex("\r\\d+ of 6000 cuts, [0-9.]+/s, \\d+ s left")));
  EXPECT_TRUE(fs::exists(folder_ / "result.json"));
}

TEST_F(CommandLine, DrawsMachines) {
  for (const auto& [name, file] :
       {std::pair{"geometry", "errors.svg"}, std::pair{"ballbar", "ballbar.svg"},
        std::pair{"compensate", "residual.svg"},
        std::pair{"positioning", "positioning.svg"}}) {
    SCOPED_TRACE(name);
    put(folder_ / "request.json", row(name).example);
    const std::string command = std::string("turnwright ") + name + " request.json";
    const auto outcome = shell(command + " --drawings new");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, shell(command).out);
    EXPECT_EQ(contents(folder_ / "new" / file).rfind("<svg ", 0), 0u);
  }
}

TEST_F(CommandLine, TheStabilityChartIsDrawnWhereSpeedsAreAsked) {
  auto request = nlohmann::json::parse(row("stability").example);
  put(folder_ / "request.json", request.dump());
  const std::string command = "turnwright stability request.json --json --drawings ";
  EXPECT_EQ(shell(command + "speeds").code, 0);
  EXPECT_EQ(contents(folder_ / "speeds" / "stability.svg").rfind("<svg ", 0), 0u);
  request.erase("speeds_rpm");
  put(folder_ / "request.json", request.dump());
  EXPECT_EQ(shell(command + "points").code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "points" / "stability.svg"));
}

TEST_F(CommandLine, DrawingsThatCannotBeWrittenAreTold) {
  put(folder_ / "request.json", row("predict").example);
  put(folder_ / "file", "old");
  for (const std::string target : {"file", "file/below"}) {
    const auto outcome =
        shell("turnwright predict request.json -o result.json --drawings " + target);
    EXPECT_EQ(outcome.code, 74);
    EXPECT_EQ(outcome.err, target + ": cannot be written: Not a directory\n");
    EXPECT_FALSE(fs::exists(folder_ / "result.json"));
  }
  EXPECT_EQ(contents(folder_ / "file"), "old");
  EXPECT_EQ(shell("turnwright acceptance request.json --drawings new").code, 2);
}

TEST_F(CommandLine, SaysWhenTheResultCannotBeWritten) {
  put(folder_ / "request.json", row("acceptance").example);
  for (const std::string target : {"nowhere/result.json", "."}) {
    SCOPED_TRACE(target);
    const auto outcome = shell("turnwright acceptance request.json -o " + target);
    EXPECT_EQ(outcome.code, 74);
    EXPECT_EQ(outcome.err.rfind(target + ": cannot be written: ", 0), 0u) << outcome.err;
  }
  EXPECT_EQ(files(), std::vector<std::string>{"request.json"});
  for (const std::string command :
       {"list materials", "--help", "plan --help", "--version"}) {
    SCOPED_TRACE(command);
    const auto outcome = shell("turnwright " + command + " > /dev/full");
    EXPECT_EQ(outcome.code, 74);
    EXPECT_NE(outcome.err.find("standard output"), std::string::npos);
  }
}

}  // namespace
}  // namespace turnwright::app
