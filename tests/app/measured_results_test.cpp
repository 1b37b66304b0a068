#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "command_line.hpp"

namespace turnwright::app {
namespace {

namespace fs = std::filesystem;

const fs::path kPins = fs::path(TURNWRIGHT_SOURCE_DIR) / "tests/data/qif/two-pins.qif";

using MeasuredResults = CommandLine;

TEST_F(MeasuredResults, AreFilesOfQif) {
  put(folder_ / "a.qif", contents(kPins));
  const auto one = shell("turnwright learn --qif a.qif --json");
  EXPECT_EQ(one.code, 0) << one.err;
  const auto result = nlohmann::json::parse(one.out);
  EXPECT_EQ(result["characteristics"][0]["values"].size(), 2u);
  // The part of a file is named by its serial number, so it is there once.
  const auto twice = shell("turnwright learn --qif a.qif a.qif");
  EXPECT_EQ(twice.code, 2);
  EXPECT_NE(twice.err.find("a.qif#line"), std::string::npos) << twice.err;
  EXPECT_NE(twice.err.find("part \"1\" twice"), std::string::npos) << twice.err;
}

TEST_F(MeasuredResults, TellTheFileThatIsBroken) {
  put(folder_ / "a.qif", contents(kPins));
  put(folder_ / "b.qif", "<QIFDocument>\n");
  const auto run = shell("turnwright learn --qif a.qif --qif b.qif");
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("b.qif#line 1"), std::string::npos) << run.err;
  // Beside a request that has members of another kind.
  put(folder_ / "r.json", R"({"qif": 5})");
  EXPECT_EQ(shell("turnwright learn r.json --qif a.qif").code, 2);
  EXPECT_EQ(shell("turnwright learn").code, 2);
}

// A byte that is no UTF-8 is a character of Latin-1, and the program answers.
TEST_F(MeasuredResults, MayBeTablesInLatin1) {
  put(folder_ / "pins.csv", "part,d\n1,25.01\n2,25.02\n3,\377\n");
  put(folder_ / "r.json",
      R"({"characteristics": [{"id": "d", "nominal_mm": 25, "upper_mm": 0.02,
          "lower_mm": 0}]})");
  const auto run = shell("turnwright learn r.json --csv pins.csv");
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("/csv#line 4/d: got "), std::string::npos) << run.err;
}

}  // namespace
}  // namespace turnwright::app
