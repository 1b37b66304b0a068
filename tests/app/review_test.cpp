#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

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
