#include <gtest/gtest.h>

#include <string>

#include "../words.hpp"
#include "report/text/text.hpp"

namespace turnwright::report::positioning_text_test {
namespace {

using nlohmann::ordered_json;

// Keys as in schemas/positioning.result.json.
TEST(PositioningText, TellsTheAxisAndItsPositions) {
  const auto result = ordered_json::parse(R"({
    "axis": "Z",
    "iso230_2": {"A_um": 14.9149, "A_plus_um": 11.439, "A_minus_um": 11.038, "R_um": 5.118,
                 "R_plus_um": 1.284, "R_minus_um": 1.283, "E_um": 13.96, "E_plus_um": 10.32,
                 "E_minus_um": 10.02, "M_um": 10.17, "B_um": 3.94, "B_mean_um": -3.823},
    "positions": [
      {"q_mm": 57, "approaches_plus": 5, "approaches_minus": 4, "mean_plus_um": 2.44,
       "mean_minus_um": 6.26, "mean_um": 4.35, "s_plus_um": 0.27, "s_minus_um": 0.24,
       "B_um": -3.82, "R_um": 4.84},
      {"q_mm": 120.5, "approaches_plus": 1, "approaches_minus": 0, "mean_plus_um": 4.56}],
    "warnings": ["Positions were approached once."],
    "comp_file": {"text": "", "type": 1, "unit": "inch"}})");
  const auto text = flat(positioning_text(result));
  for (const char* line :
       {"POSITIONING axis Z, ISO 230-2", "\n accuracy A 14.91 11.44 11.04\n",
        "\n repeatability of positioning R 5.12 1.28 1.28\n",
        "\n systematic deviation E 13.96 10.32 10.02\n",
        "\n mean deviation M 10.17 - -\n", "\n reversal, largest B 3.94 - -\n",
        "\n reversal, mean B -3.82 - -\n",
        "\n 57.000 5 4 2.44 6.26 0.27 0.24 -3.82 4.84\n",
        "\n 120.500 1 0 4.56 - - - - -\n", "2 rows in inch, COMP_FILE_TYPE = 1",
        "- Positions were approached once."})
    EXPECT_TRUE(has(text, line)) << line << text;
}

TEST(PositioningText, WhatIsMissingLeavesItsLineOut) {
  const auto text = flat(positioning_text(ordered_json::object()));
  EXPECT_TRUE(has(text, "accuracy A - - -"));
  EXPECT_FALSE(has(text, "AT EACH POSITION"));
  EXPECT_FALSE(has(text, "COMP_FILE"));
}

}  // namespace
}  // namespace turnwright::report::positioning_text_test
