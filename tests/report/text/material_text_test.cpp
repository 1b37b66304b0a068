#include <gtest/gtest.h>

#include "../words.hpp"
#include "report/text/text.hpp"

namespace turnwright::report::material_text_test {
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

TEST(MaterialText, LivesOfEdgesLabsAndReplicas) {
  auto result = answered();
  result["taylor"]["censored"] = 2;
  result["taylor"]["edges"] = ordered_json::parse(R"({
    "distribution": "weibull", "ln_likelihood_ratio": -1.5, "weibull_shape": 3.456,
    "scatter_pct": {"value": 31.23, "lower": 22, "upper": 51.26},
    "lack_of_fit_pct": 4.44, "lack_of_fit_p": 0.3,
    "T50_min": {"value": 20.44, "lower": 17, "upper": 24},
    "T90_min": {"value": 12.34, "lower": 9.87, "upper": 15},
    "at": {"vc_m_min": 200, "f_mm_rev": 0.2, "ap_mm": 1.5}})");
  result["roughness"] = {
      {"cuts", 4},
      {"outliers", ordered_json::array()},
      {"degrees_of_freedom", 3},
      {"s_pct", 12},
      {"hmin_mm", {{"value", 0.00234}, {"lower", 0}, {"upper", 0.004}}}};
  result["labs"] = {
      {{"lab", "ours"},
       {"kc11_factor", {{"value", 1.08}, {"lower", 1.01}, {"upper", 1.15}, {"cuts", 6}}}},
      {{"lab", "maker"}}};
  result["left_out_replicas"] = {{{"replica", "first"}, {"Fc_rms_pct", 3.21}}};
  const auto text = flat(material_text(result));
  EXPECT_TRUE(has(text,
                  "\n half of the edges reach 20.4 min (17 to 24), 90 % of them 12.3 min "
                  "(9.87 to 15), at vc 200"))
      << text;
  EXPECT_TRUE(has(text,
                  "\n their lives are likelier Weibull's than lognormal; Weibull's shape "
                  "is 3.46\n"))
      << text;
  EXPECT_TRUE(
      has(text,
          "\n edges at equal conditions scatter by 31.2 % (22.0 to 51.3), lack of "
          "fit 4.4 %\n"))
      << text;
  EXPECT_TRUE(has(text, "\n longer than their test: 2 lives\n")) << text;
  EXPECT_TRUE(has(text, "\nROUGHNESS\n 4 cuts")) << text;
  EXPECT_TRUE(has(text, "\n hmin_mm 0.00234 0 0.004\n")) << text;
  EXPECT_TRUE(
      has(text, "\nLABS\n factor from to cuts\n ours kc11_factor 1.08 1.01 1.15 6\n"))
      << text;
  EXPECT_TRUE(has(text, "rms error in %\n Fc Ff Fp\n first 3.2 - -\n")) << text;
}

TEST(MaterialText, LacksWhatTheResultLacks) {
  const auto text = flat(material_text(ordered_json::object()));
  EXPECT_TRUE(has(text, "confidence of - %"));
  EXPECT_FALSE(has(text, "TOOL LIFE"));
}

}  // namespace
}  // namespace turnwright::report::material_text_test
