#include "command_line.hpp"

// The folder of --nc: whoever carries it to the machine finds programs of one plan.
namespace turnwright::app {
namespace {

using nlohmann::json;

class Programs : public CommandLine {
 protected:
  Outcome run(const std::string& name, const json& request,
              const std::string& more = "") const {
    put(folder_ / "request.json", request.dump());
    return shell("turnwright " + name + " request.json --nc nc " + more);
  }
  /// A plan of two setups, and what does not come from this program.
  void earlier() const {
    EXPECT_EQ(run("plan", json::parse(row("plan").example)).code, 0);
    for (const char* own : {"setup-1.txt", "setup-a.ngc", "setup-.ngc", "setup-00.ngc",
                            "setup-1.ngc.bak", "notes.txt"})
      put(folder_ / "nc" / own, "mine");
  }
  std::vector<std::string> programs() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_ / "nc")) {
      if (contents(entry.path()) != "mine") names.push_back(entry.path().filename());
    }
    std::sort(names.begin(), names.end());
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "nc"), {}),
              static_cast<std::ptrdiff_t>(names.size() + 6));
    return names;
  }
  static json infeasible() {
    return json::parse(
        contents(fs::path(TURNWRIGHT_SOURCE_DIR) / "parts/infeasible-as-drawn.json"));
  }
  json from_the_chuck() const {
    auto request = json::parse(row("predict").example);
    request["operations"][2]["direction"] = "from-chuck";
    return request;
  }
};

using Names = std::vector<std::string>;
const std::string kRemoved =
    "removed nc/setup-1.ngc, of an earlier plan\n"
    "removed nc/setup-2.ngc, of an earlier plan\n"
    "removed nc/tools.tbl, of an earlier plan\n";
const std::string kWhy =
    "no NC program: setup 1, e2: no program is made for turning from the chuck "
    "outwards\n";

TEST_F(Programs, OfAnEarlierPlanGoWhenThereIsNoPlan) {
  earlier();
  EXPECT_EQ(programs(), (Names{"setup-1.ngc", "setup-2.ngc", "tools.tbl"}));
  const auto outcome = run("plan", infeasible());
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.err, kRemoved + "no NC program: there is no feasible plan\n");
  EXPECT_EQ(programs(), Names{});
}

TEST_F(Programs, OfAnEarlierPlanGoWhenNoneCanBeMade) {
  earlier();
  const auto outcome = run("predict", from_the_chuck());
  EXPECT_EQ(outcome.code, 3);
  EXPECT_EQ(outcome.err, kRemoved + kWhy);
  EXPECT_EQ(programs(), Names{});
  EXPECT_NE(outcome.out, "");  // the prediction itself stands
  const auto without = shell("turnwright predict request.json");
  EXPECT_EQ(without.code, 0);
  EXPECT_EQ(without.out, outcome.out);
  EXPECT_EQ(shell("turnwright predict request.json --report report.html").code, 0);
}

TEST_F(Programs, OfSetupsThatAreNoMoreGo) {
  earlier();
  put(folder_ / "nc/setup-3.ngc", "old");
  put(folder_ / "nc/setup-170.ngc", "old");
  const auto outcome = run("plan", json::parse(row("plan").example));
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.err,
            "removed nc/setup-170.ngc, of an earlier plan\n"
            "removed nc/setup-3.ngc, of an earlier plan\n");
  EXPECT_EQ(programs(), (Names{"setup-1.ngc", "setup-2.ngc", "tools.tbl"}));
}

TEST_F(Programs, ThatCannotBeWrittenLeaveTheOldOnesWhole) {
  earlier();
  const auto old = contents(folder_ / "nc/setup-1.ngc");
  auto other = json::parse(row("plan").example);
  other["outer"][1]["diameter_mm"] = 24;
  put(folder_ / "request.json", other.dump());
  // The first program fits, a later file does not: half a kilobyte is the shell's block.
  const auto outcome = shell(
      "trap '' XFSZ; ulimit -f 1; turnwright plan request.json --nc nc > /dev/null");
  EXPECT_EQ(outcome.code, 74);
  EXPECT_NE(outcome.err.find("cannot be written: File too large"), std::string::npos)
      << outcome.err;
  EXPECT_EQ(programs(), (Names{"setup-1.ngc", "setup-2.ngc", "tools.tbl"}));
  EXPECT_EQ(contents(folder_ / "nc/setup-1.ngc"), old);
}

TEST_F(Programs, LinksAreFollowed) {
  fs::create_directories(folder_ / "nc");
  put(folder_ / "card", "old");
  put(folder_ / "second card", "old");
  fs::create_symlink("../card", folder_ / "nc/setup-1.ngc");
  fs::create_symlink("../second card", folder_ / "nc/setup-6.ngc");
  const auto outcome = run("plan", json::parse(row("plan").example));
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(fs::is_symlink(folder_ / "nc/setup-1.ngc"));
  EXPECT_NE(contents(folder_ / "card"), "old");
  EXPECT_FALSE(fs::is_symlink(fs::symlink_status(folder_ / "nc/setup-6.ngc")));
  EXPECT_FALSE(fs::exists(folder_ / "second card"));
}

TEST_F(Programs, AreFilesAFolderOfTheirNameStays) {
  fs::create_directories(folder_ / "nc/setup-4.ngc");
  const auto outcome = run("plan", json::parse(row("plan").example));
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_TRUE(fs::is_directory(folder_ / "nc/setup-4.ngc"));
}

TEST_F(Programs, OfTheDoorNcEndLikeThoseOfPlan) {
  const auto nc = [this](const json& part) {
    put(folder_ / "request.json", json{{"part", part}}.dump());
    return shell("turnwright nc request.json --json");
  };
  EXPECT_EQ(nc(infeasible()).code, 1);
  EXPECT_EQ(nc(json::parse(row("plan").example)).code, 0);
  const auto awkward = json::parse(
      contents(fs::path(TURNWRIGHT_SOURCE_DIR) / "tests/data/awkward_parts.json"));
  const auto part = std::find_if(awkward.begin(), awkward.end(), [](const json& one) {
                      return one["part"]["name"] == "arc-behind-step";
                    })->at("part");
  const auto none = nc(part);
  EXPECT_EQ(none.code, 3);
  EXPECT_EQ(json::parse(none.out).at("status"), "not-programmed");
  const auto why = json::parse(none.out).at("cannot")[0];
  EXPECT_EQ(json::parse(run("plan", part, "--json").out).at("conflicts")[0]["sentence"],
            why);
  EXPECT_EQ(shell("turnwright nc request.json --setup 1").err,
            "no NC program: " + why.get<std::string>() + '\n');
}

TEST_F(Programs, ForAnotherControlTakeThePlaceOfThoseForLinuxCnc) {
  earlier();
  put(folder_ / "nc/setup-0.ngc", "old");
  const auto outcome =
      run("plan", json::parse(row("plan").example), "--control haas --program-number 50");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.err, "removed nc/setup-0.ngc, of an earlier plan\n" + kRemoved);
  EXPECT_EQ(programs(), (Names{"setup-1.nc", "setup-2.nc"}));
  EXPECT_EQ(contents(folder_ / "nc/setup-2.nc").substr(0, 9), "%\nO00051\n");
}

// A part alone, or in the request of `nc`; options go before what the request says.
TEST_F(Programs, OfOneSetupAreTheTextAlone) {
  const auto part = json::parse(row("plan").example);
  put(folder_ / "part.json", part.dump());
  put(folder_ / "request.json", json{{"part", part}, {"control", "okuma"}}.dump());
  const auto whole = json::parse(shell("turnwright nc request.json --json").out);
  const auto text = whole.at("programs")[1]["text"].get<std::string>();
  EXPECT_EQ(whole["settings"]["control"], "okuma");
  for (const char* same : {"nc request.json --setup 2", "nc request.json --setup 2 -o -",
                           "nc part.json --control okuma --setup 2",
                           "nc request.json --setup 2 -o file && cat file"}) {
    const auto one = shell(std::string("turnwright ") + same);
    EXPECT_EQ(one.code, 0) << same;
    EXPECT_EQ(one.out, text) << same;
  }
  const auto other = shell("turnwright nc request.json --control haas --setup 2");
  EXPECT_EQ(other.out.substr(0, 9), "%\nO00002\n");

  const auto beyond = shell("turnwright nc part.json --setup 3");
  EXPECT_EQ(beyond.code, 2);
  EXPECT_EQ(beyond.err,
            "command line: --setup: got 3, expected a setup with a program: 1, 2\n");
}

TEST_F(Programs, ProblemsHaveTheirPlaceInTheUsersDocument) {
  auto part = json::parse(row("plan").example);
  part["outer"][0]["length_mm"] = -1;
  put(folder_ / "part.json", part.dump());
  EXPECT_NE(
      shell("turnwright nc part.json").err.find("part.json: /outer/0/length_mm: got -1"),
      std::string::npos);
  put(folder_ / "request.json", json{{"part", part}}.dump());
  EXPECT_NE(shell("turnwright nc request.json")
                .err.find("request.json: /part/outer/0/length_mm: got -1"),
            std::string::npos);
}

TEST_F(Programs, OptionsNameThemselvesWhereTheyAreWrong) {
  put(folder_ / "part.json", row("plan").example);
  for (const auto& [options, told] :
       {std::pair{"--control heidenhain", "--control: got \"heidenhain\", expected"},
        {"--control okuma --work-offset G54",
         "--work-offset: got \"G54\", expected none"},
        {"--program-number 1", "--program-number: got 1, expected none"},
        {"--program-number x", "--program-number: got \"x\", expected an integer"},
        {"--tool A=1 --tool A=2", "--tool: got \"A\", expected one that no other"},
        {"--tool A", "--tool: got \"A\", expected ID=NUMBER or ID=NUMBER:OFFSET"},
        {"--control haas --tool A=1:x", "--tool: got \"A=1:x\", expected ID=NUMBER"},
        {"--tool A=100", "--tool: got 100, expected"}}) {
    const auto outcome = shell(std::string("turnwright nc part.json ") + options);
    EXPECT_EQ(outcome.code, 2) << options;
    EXPECT_NE(outcome.err.find(std::string("command line: ") + told), std::string::npos)
        << outcome.err;
  }
  EXPECT_EQ(shell("turnwright plan part.json --control haas").code, 2);
}

}  // namespace
}  // namespace turnwright::app
