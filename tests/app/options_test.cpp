#include <regex>

#include "command_line.hpp"

// What may stand behind an option: the rules hold for every option of every command.
namespace turnwright::app {
namespace {

struct Option {
  std::string command, name, type;
};

/// The options that the helps show with a value.
std::vector<Option> options_of(const std::string& command, const std::string& help) {
  std::vector<Option> all;
  const std::regex row(R"(\n  (?:-\w,)?(--[a-z-]+) (INT|NUMBER|TEXT)\b)");
  for (std::sregex_iterator it(help.begin(), help.end(), row), end; it != end; ++it)
    all.push_back({command, (*it)[1], (*it)[2]});
  return all;
}

class Options : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    put(folder_ / "request.json", row("plan").example);
    put(folder_ / "lines.jsonl", "\n");
  }
  std::vector<Option> all() const {
    std::vector<Option> options;
    const auto add = [&](const std::string& command, const std::string& help) {
      const auto more = options_of(command, shell(help).out);
      options.insert(options.end(), more.begin(), more.end());
    };
    add("turnwright serve", "turnwright serve --help");
    add("turnwright batch lines.jsonl", "turnwright batch --help");
    for (const auto& row : service::requests())
      add("turnwright " + row.name + " request.json",
          "turnwright " + row.name + " --help");
    return options;
  }
  void refused(const std::string& command, const std::string& start) const {
    const auto run = shell("timeout 60 " + command);
    EXPECT_EQ(run.code, 2) << command;
    EXPECT_EQ(run.out, "") << command;
    EXPECT_EQ(run.err.rfind(start, 0), 0U) << command << '\n' << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
};

TEST_F(Options, NumbersAreDecimalAndWithinTheirRange) {
  int numbers = 0;
  for (const auto& option : all()) {
    if (option.type == "TEXT") continue;
    ++numbers;
    for (const std::string wrong :
         {"nan", "inf", "-inf", "-1", " 1", "1x", "+1", "0x1", "1e400", "1,5", "--2",
          "99999999999999999999", "1.5e"})
      if (wrong != "-1" || option.name != "--zero")  // a place may be negative
        refused(option.command + ' ' + option.name + "='" + wrong + '\'',
                "command line: " + option.name + ": got \"" + wrong + "\", expected a");
    refused(option.command + ' ' + option.name + " ''",
            "command line: " + option.name + ": got \"\", expected a");
  }
  // seven of serve, three of batch, one of nc, two of review, two of listen
  EXPECT_EQ(numbers, 15);
  for (const std::string zero :
       {"serve --deadline 0", "serve --connections 0", "serve --batch-threads 0",
        "batch lines.jsonl -o r --jobs 0", "batch lines.jsonl -o r --chunk 0"})
    EXPECT_EQ(shell("timeout 60 turnwright " + zero).code, 2) << zero;
  refused(
      "turnwright serve --deadline nan",
      "command line: --deadline: got \"nan\", expected a number from 0.001 to 86400\n");
  refused("turnwright serve --port 65536",
          "command line: --port: got \"65536\", expected an integer from 0 to 65535\n");
}

TEST_F(Options, PathsAreNames) {
  int paths = 0;
  for (const auto& option : all()) {
    if (option.type != "TEXT" || option.name == "--shard" || option.name == "--address" ||
        option.name == "--output")
      continue;
    ++paths;
    for (const std::string none : {"", "-"})
      refused(option.command + ' ' + option.name + " '" + none + '\'',
              "command line: " + option.name + ": got \"" + none +
                  "\", expected a name in the file system");
  }
  EXPECT_GE(paths, 10);
  for (const std::string none : {"''", "-"})
    refused("turnwright batch lines.jsonl -o " + none, "command line: --output: got \"");
  refused("turnwright plan request.json -o ''", "command line: --output: got \"\"");
  refused("turnwright --data - list parts", "command line: --data: got \"-\"");
  EXPECT_EQ(files(), (std::vector<std::string>{"lines.jsonl", "request.json"}));
}

TEST_F(Options, OutputToADashIsStandardOutput) {
  for (const auto& row : service::requests()) {
    if (row.name == "import") continue;  // its output is the part alone: import_test
    put(folder_ / "request.json", row.example);
    const std::string command = "turnwright " + row.name + " request.json ";
    const auto run = shell(command + "-o -");
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(run.out, shell(command + "--json").out) << row.name;
    EXPECT_EQ(run.err, "");
  }
  EXPECT_EQ(files(), (std::vector<std::string>{"lines.jsonl", "request.json"}));
}

TEST_F(Options, APortThatIsTakenIsTold) {
  const auto run = shell(
      "mkfifo told; exec 3<> told; turnwright serve --port 0 --jobs a.sqlite 1>&3 "
      "2> /dev/null & read -r line <> told; port=${line##*:}; port=${port%/}; "
      "turnwright serve --port \"$port\" --jobs b.sqlite; code=$?; echo \"$port\"; "
      "kill $!; wait; exit $code");
  EXPECT_EQ(run.code, 2);
  const auto port = run.out.substr(0, run.out.find('\n'));
  EXPECT_EQ(run.err, "command line: --port: got " + port +
                         ": Address already in use, expected a port that is free and "
                         "that this user may listen on\n");
}

TEST_F(Options, AddressesThatAreNotThisMachinesAreTold) {
  put(folder_ / "keys", "a-key-of-20-characters\n");
  refused("turnwright serve --port 0 --jobs jobs --keys keys --address 192.0.2.1",
          "command line: --address: got 192.0.2.1: Cannot assign requested address, "
          "expected an address of this machine\n");
  refused("turnwright serve --port 0 --jobs jobs --address localhost",
          "command line: --address: got localhost, expected a numeric IP address\n");
  refused(
      "turnwright serve --port 0 --jobs jobs --address 0.0.0.0",
      "command line: --address: got 0.0.0.0, expected a loopback address, or keys for "
      "the callers (--keys)\n");
}

TEST_F(Options, AFolderIsNoFileOfKeys) {
  refused("turnwright serve --port 0 --jobs jobs --keys .",
          ".: document: got no regular file, expected a file of keys\n");
}

TEST_F(Options, AJobStoreThatIsNoneIsTold) {
  const std::string wanted =
      ", expected a job store of this version that no other process has open\n";
  put(folder_ / "text", std::string(4096, 'x'));
  refused("turnwright serve --port 0 --jobs text",
          "command line: --jobs: got text: file is not a database" + wanted);
  EXPECT_EQ(contents(folder_ / "text"), std::string(4096, 'x'));
  refused("turnwright serve --port 0 --jobs none/jobs",
          "command line: --jobs: got none/jobs: unable to open database file" + wanted);
  refused("turnwright serve --port 0 --jobs .",
          "command line: --jobs: got .: unable to open database file" + wanted);
  const auto locked = shell(
      "mkfifo told; exec 3<> told; turnwright serve --port 0 --jobs jobs 1>&3 2> "
      "/dev/null & read -r line <> told; timeout 60 turnwright serve --port 0 --jobs "
      "jobs; code=$?; kill $!; wait; exit $code");
  EXPECT_EQ(locked.code, 2);
  EXPECT_EQ(locked.err, "command line: --jobs: got jobs: database is locked" + wanted);
}

}  // namespace
}  // namespace turnwright::app
