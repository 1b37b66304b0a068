#include <gtest/gtest.h>

#include "../words.hpp"
#include "report/text/text.hpp"

namespace turnwright::report {
namespace {

using nlohmann::ordered_json;

// Keys as in schemas/calibrate-material.result.json.
ordered_json answered() {
  return ordered_json::parse(R"({
    "confidence": 0.95,
    "cutting": {"cuts": 9, "outliers": [3, 7], "degrees_of_freedom": 7, "s_pct": 1.234,
                "kc11_MPa": {"value": 1712.34, "lower": 1650, "upper": 1775.5},
                "mc": {"value": 0.2512, "lower": 0.22, "upper": 0.28}},
    "taylor": {"cuts": 5, "outliers": [], "degrees_of_freedom": 3, "s_pct": 4,
               "C": {"value": 402.1, "lower": 380, "upper": 425},
               "n": {"value": 0.21, "lower": 0.19, "upper": 0.23},
               "a": {"value": 0.3, "given": true}},
    "material": {"id": "C45-lot-17", "name": "C45, lot 17"},
    "warnings": ["b stays at its given 0.15"]})");
}

TEST(MaterialText, ConstantsHaveTheirIntervals) {
  const auto text = flat(material_text(answered()));
  EXPECT_TRUE(has(text, "\n intervals hold with a confidence of 95.0 %\n"));
  EXPECT_TRUE(has(text,
                  "\nCUTTING FORCE\n 9 cuts, 7 degrees of freedom, residual scatter "
                  "1.23 %; left out as outliers: cuts 3, 7\n"));
  EXPECT_TRUE(has(text, "\n kc11_MPa 1712.3 1650 1775.5\n"));
  EXPECT_TRUE(has(text, "\n mc 0.2512 0.22 0.28\n"));
  EXPECT_TRUE(has(text, "\n a 0.3 - - as given\n"));
  EXPECT_FALSE(has(text, "FEED FORCE"));
  EXPECT_TRUE(has(text, "\nMATERIAL C45-lot-17 (C45, lot 17) stands whole"));
  EXPECT_TRUE(has(text, "\n - b stays at its given 0.15\n"));
}

TEST(MaterialText, LacksWhatTheResultLacks) {
  const auto text = flat(material_text(ordered_json::object()));
  EXPECT_TRUE(has(text, "confidence of - %"));
  EXPECT_FALSE(has(text, "TOOL LIFE"));
}

}  // namespace
}  // namespace turnwright::report
