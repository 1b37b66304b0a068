#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "command_line.hpp"

namespace turnwright::app {
namespace {

constexpr const char* kPin = "d32 x 30; 1x45; d25 h8 x 50 Ra1.6\n";

class Import : public CommandLine {};

TEST_F(Import, PipesAPartToThePlanner) {
  put(folder_ / "pin.txt", kPin);
  const auto outcome = shell(
      "turnwright import pin.txt --material C45 --quiet | turnwright plan - --json");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const auto plan = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(plan["status"], "ok");
  // Two of them are parted off a longer bar, and one way of setting up leaves stock behind the
  // edge between the diameters, which is planned with that shoulder faced and without.
  EXPECT_EQ(plan["alternatives"].size(), 7u);
}

TEST_F(Import, TellsWhatItAssumedOnStandardErrorAlone) {
  put(folder_ / "pin.txt", kPin);
  const auto outcome = shell("turnwright import pin.txt --material C45");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(nlohmann::json::parse(outcome.out)["outer"].size(), 2u);
  EXPECT_NE(outcome.err.find("assumed: /stock: The stock is the next round bar, 35 mm"),
            std::string::npos)
      << outcome.err;
  const auto whole = shell("turnwright import pin.txt --material C45 --json");
  EXPECT_EQ(whole.err, "");
  EXPECT_EQ(nlohmann::json::parse(whole.out)["source"], "notation");
}

TEST_F(Import, WritesThePartWholeOrNotAtAll) {
  put(folder_ / "pin.txt", kPin);
  EXPECT_EQ(shell("turnwright import pin.txt --material C45 -o part.json").out, "");
  EXPECT_EQ(shell("turnwright plan part.json --json").code, 0);
  put(folder_ / "wrong.txt", "d32 x 3O; d25 x\n");
  const auto wrong = shell("turnwright import wrong.txt --material C45 -o none.json");
  EXPECT_EQ(wrong.code, 2);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "none.json"));
  EXPECT_EQ(wrong.err.rfind("wrong.txt: document: got line 1, column", 0), 0u)
      << wrong.err;
}

TEST_F(Import, NamesTheOptionOrTheFileThatIsWrong) {
  put(folder_ / "pin.txt", kPin);
  EXPECT_EQ(shell("turnwright import pin.txt")
                .err.rfind("command line: --material: got "
                           "nothing, expected a material",
                           0),
            0u);
  EXPECT_EQ(
      shell("turnwright import elsewhere.step --material C45").err,
      "elsewhere.step: document: got nothing readable, expected a STEP, DXF or text "
      "file\n");
  EXPECT_EQ(shell("turnwright import . --material C45").code, 2);
  EXPECT_EQ(
      shell("turnwright new -o part.json && turnwright import part.json").err,
      "part.json: document: got a part document, expected a drawing, for plan takes "
      "this file as it is\n");
  EXPECT_EQ(shell("turnwright import - --material C45 < /dev/null").code, 2);
}

TEST_F(CommandLine, PrintsSchemas) {
  const auto part = shell("turnwright schema part");
  EXPECT_EQ(part.code, 0);
  EXPECT_EQ(nlohmann::json::parse(part.out)["title"], "Part plan");
  EXPECT_EQ(shell("turnwright schema plan").out, part.out);
  EXPECT_NE(shell("turnwright list schemas").out.find("plan.result "), std::string::npos);
  EXPECT_EQ(shell("turnwright schema").out, shell("turnwright list schemas").out);
  const auto wrong = shell("turnwright schema parts");
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.err.find("did you mean \"part\"?"), std::string::npos) << wrong.err;
}

}  // namespace
}  // namespace turnwright::app
