#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "command_line.hpp"
#include "service/requests.hpp"

namespace turnwright::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class ReviewCommand : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    put(folder_ / "request.json", service::find_request("review")->example);
    const auto request = json::parse(service::find_request("review")->example);
    put(folder_ / "part.json", request["part"].dump());
    put(folder_ / "1.nc", request["programs"][0]["text"].get<std::string>());
  }
  void refused(const std::string& arguments, const std::string& told) {
    const auto run = shell("turnwright review " + arguments);
    EXPECT_EQ(run.code, 2) << arguments;
    EXPECT_EQ(run.err, told) << arguments;
    EXPECT_EQ(run.out, "");
  }
};

const std::string kOptions =
    " --part part.json --control fanuc --tool 1=PCLNL-CNMG120408-PM";

TEST_F(ReviewCommand, TakesProgramsOrARequest) {
  const auto of_request = json::parse(shell("turnwright review request.json --json").out);
  const auto of_program =
      json::parse(shell("turnwright review 1.nc --json" + kOptions).out);
  EXPECT_EQ(of_program["setups"], of_request["setups"]);
  EXPECT_EQ(of_program["plan"], of_request["plan"]);
  EXPECT_EQ(shell("turnwright review - < 1.nc" + kOptions).out,
            shell("turnwright review 1.nc" + kOptions).out);
  const auto text = shell("turnwright review 1.nc" + kOptions).out;
  EXPECT_NE(text.find("SETUP 1"), std::string::npos) << text;
  EXPECT_NE(text.find("The certified plan takes"), std::string::npos) << text;
  EXPECT_EQ(shell("turnwright review request.json -o r.json").code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "r.json"));
}

TEST_F(ReviewCommand, ReviewsTheSetupAndZeroThatAreAsked) {
  const auto second = json::parse(
      shell("turnwright review 1.nc --json --setup 2 --zero 5" + kOptions).out);
  EXPECT_EQ(second["setups"][0]["setup"], 1);
  const auto first = json::parse(shell("turnwright review 1.nc --json" + kOptions).out);
  EXPECT_NE(second["setups"][0]["cuts"], first["setups"][0]["cuts"]);
}

// Programs of a plan, slowed down and fed less, come back to its time.
TEST_F(ReviewCommand, CorrectsSlowProgramsToTheTimeOfThePlan) {
  for (const char* control : {"linuxcnc", "fanuc", "siemens"}) {
    const std::string of = std::string(" --control ") + control;
    ASSERT_EQ(shell("turnwright plan part.json --nc made" + of).code, 0);
    fs::create_directory(folder_ / "slow");
    std::string files, made;
    for (const auto& entry : fs::directory_iterator(folder_ / "made")) {
      const auto name = entry.path().filename().string();
      if (!name.starts_with("setup-")) continue;
      const auto slow = std::regex_replace(contents(entry.path()),
                                           std::regex("F(0\\.[0-9]+)"), "F0.051");
      put(folder_ / "slow" / name,
          std::regex_replace(slow, std::regex("S[1-3][0-9][0-9]\\b"), "S99"));
    }
    for (const char* setup : {"setup-1", "setup-2"})
      for (const auto& entry : fs::directory_iterator(folder_ / "slow"))
        if (entry.path().stem() == setup) {
          files += " slow/" + entry.path().filename().string();
          made += " made/" + entry.path().filename().string();
        }
    const auto review = "turnwright review" + files + " --part part.json --json" + of;
    const auto run = shell(review + " --corrected good");
    ASSERT_EQ(run.code, 0) << run.err;
    const auto result = json::parse(run.out);
    ASSERT_TRUE(result.contains("corrected")) << result["not_corrected"];
    const auto& corrected = result["corrected"];
    EXPECT_EQ(corrected["status"], "kept");
    const auto planned = json::parse(
        shell("turnwright review" + made + " --part part.json --json" + of).out);
    double cost = 0, slow = 0;
    for (const auto& s : planned["setups"]) cost += s["spent"]["cost"].get<double>();
    for (const auto& s : result["setups"]) slow += s["spent"]["cost"].get<double>();
    EXPECT_GT(slow, 1.5 * cost);
    EXPECT_NEAR(corrected["spent"]["cost"].get<double>() / cost, 1, 0.03) << control;
    EXPECT_NEAR(corrected["saves"]["cost"].get<double>(),
                slow - corrected["spent"]["cost"].get<double>(), 1e-9);
    // Nothing but F and S is changed.
    for (const auto& program : corrected["programs"]) {
      const auto& text = program["text"].get<std::string>();
      EXPECT_GT(program["words"].size(), 2U);
      const auto name = files.substr(6 + (program["setup"] == 0 ? 0 : files.size() / 2),
                                     files.size() / 2 - 6);
      EXPECT_EQ(contents(folder_ / "good" / name), text);
      const std::regex words("[FS]=?[0-9.]+");
      EXPECT_EQ(std::regex_replace(text, words, ""),
                std::regex_replace(contents(folder_ / "slow" / name), words, ""));
    }
    for (const char* each : {"made", "slow", "good"}) fs::remove_all(folder_ / each);
  }
}

TEST_F(ReviewCommand, DoesNotWriteOverProgramsGiven) {
  refused(
      "1.nc --corrected ." + kOptions,
      "command line: --corrected: got \".\", expected a folder other than that of the "
      "programs, which have names of their own\n");
  refused(
      "1.nc 1.nc --corrected new" + kOptions,
      "command line: --corrected: got \"new\", expected a folder other than that of the "
      "programs, which have names of their own\n");
}

// The second setup has no program: what the first one's operations are is not complete.
TEST_F(ReviewCommand, TellsWhyProgramsAreNotCorrected) {
  const auto run = shell("turnwright review 1.nc --corrected new" + kOptions);
  EXPECT_NE(run.out.find("CORRECTED PROGRAMS cannot be given\n  setup 2 has no program"),
            std::string::npos)
      << run.out;
  EXPECT_FALSE(fs::exists(folder_ / "new"));
}

TEST_F(ReviewCommand, RefusesWrongOptions) {
  refused("1.nc 1.nc",
          "command line: --part: got nothing, expected the part document of the "
          "programs\n");
  refused("1.nc --part part.json --tool PCLNL",
          "command line: --tool: got \"PCLNL\", expected a number, = and an id\n");
  refused("1.nc --part part.json --tool 1=NONE",
          "command line: --tool: got NONE, expected the id of a tool of the part or "
          "catalogue\n");
  refused("1.nc --part part.json --tool 1=DRILL-HM-5D",
          "command line: --tool: got nothing, expected the diameter of a drill or the "
          "width of a blade\n");
  EXPECT_EQ(shell("turnwright review none.nc" + kOptions).code, 2);
  EXPECT_EQ(shell("turnwright review 1.nc --control heidenhain --part part.json").code,
            2);
}

}  // namespace
}  // namespace turnwright::app
