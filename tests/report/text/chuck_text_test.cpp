#include <gtest/gtest.h>

#include <sstream>

#include "../words.hpp"
#include "report/text/text.hpp"

namespace turnwright::report::chuck_text_test {
namespace {

using nlohmann::ordered_json;

// Keys as in schemas/chuck.result.json.
ordered_json fitted() {
  return ordered_json::parse(R"({
    "turnwright_version": "0.1.0", "request_digest": "0123456789abcdef",
    "chuck": {"radial": {"c0_mm_N": 1.8e-5, "c1_rad_N": 8e-8, "c2_rad_Nmm": 1e-9}},
    "radial": {
      "u": {"c0_mm_N": 9e-7, "c1_rad_N": 2e-9, "c2_rad_Nmm": 5e-11},
      "springs": {"Lc_range_mm": [80, 225], "Lc_mm": 80, "k1_N_mm": 86207,
                  "k2_Nmm_rad": 1e9, "k3_Nmm_rad": null, "u_k1_N_mm": 4310.35,
                  "u_k2_Nmm_rad": 2.5e7, "u_k3_Nmm_rad": null},
      "offsets": [{"setup": "A", "offset_mm": 0.0101, "u_mm": 0.0005},
                  {"setup": "B", "offset_mm": -0.02, "u_mm": 0.0004}],
      "outliers": [4, 7], "s_mm": 0.00123, "degrees_of_freedom": 17,
      "on_border": true, "contradiction": 2.345},
    "predictions": [
      {"z_mm": 120.5, "Fr_N": 250, "delta_r_mm": 0.01234, "u_delta_r_mm": 0.0005,
       "radius_error_mm": 0.01235, "u_radius_error_mm": 0.00051}],
    "identifiability": {"radial": {"rank": 3}},
    "warnings": ["radial: look again"]})");
}

/// The words of the first line that begins with `word`.
std::vector<std::string> line(const std::string& text, const std::string& word) {
  std::istringstream lines(text);
  for (std::string one; std::getline(lines, one);) {
    std::istringstream in(one);
    std::vector<std::string> words;
    for (std::string w; in >> w;) words.push_back(w);
    if (!words.empty() && words[0] == word) return words;
  }
  return {};
}

using Words = std::vector<std::string>;

TEST(ChuckText, SpringsAndComplianceHaveTheirErrors) {
  const auto text = chuck_text(fitted());
  EXPECT_EQ(line(text, "c0"), (Words{"c0", "1.8e-05", "9e-07", "5.0", "mm/N"}));
  EXPECT_EQ(line(text, "c2"), (Words{"c2", "1e-09", "5e-11", "5.0", "rad/(N", "mm)"}));
  EXPECT_EQ(line(text, "k1"), (Words{"k1", "8.621e+04", "4310", "5.0", "N/mm"}));
  EXPECT_EQ(line(text, "k3"), (Words{"k3", "rigid", "-", "-", "N", "mm/rad"}));
  EXPECT_TRUE(has(text, "Lc = 80.0 mm; any from 80.0 to 225.0 mm")) << text;
  EXPECT_TRUE(has(text, "scatter of a cut 1.23 um, 17 degrees of freedom"));
  EXPECT_TRUE(has(text, "A: 10.10 (0.50), B: -20.00 (0.40)"));
  EXPECT_TRUE(has(text, "cuts left out, counted from 0: 4, 7"));
  EXPECT_TRUE(has(text, "fits 2.35 s^2 better") || has(text, "fits 2.34 s^2 better"));
  EXPECT_TRUE(has(text, "from request 0123456789ab\n"));
  EXPECT_TRUE(has(text, "  - radial: look again"));
}

TEST(ChuckText, PredictionsStandAtTheirPlaces) {
  EXPECT_EQ(line(chuck_text(fitted()), "120.5"),
            (Words{"120.5", "250", "12.34", "0.50", "-", "-", "12.35", "0.51"}));
}

TEST(ChuckText, ADesignTellsWhatIsMissing) {
  const auto text = chuck_text(ordered_json::parse(R"({
    "identifiability": {
      "radial": {"rank": 2, "degrees_of_freedom": 3,
        "null_directions": [{"words": "c0 with the setups' offsets"}],
        "missing": ["a cut at another force in setup A", "a cut at a third z in setup A"],
        "setups_of_one_force": ["A", "B"]},
      "tangential": {"rank": 3, "degrees_of_freedom": 1, "null_directions": [],
        "missing": [], "setups_of_one_force": [], "condition": 12.3456,
        "largest_u_per_s": 1.75, "most_useful": "a cut at another force in setup A"}},
    "warnings": []})"));
  EXPECT_TRUE(has(text, "RADIAL  2 of c0, c1, c2 are determined, 3 degrees of freedom"));
  EXPECT_TRUE(has(text, "not determined: c0 with the setups' offsets"));
  EXPECT_TRUE(
      has(text, "missing: a cut at another force in setup A and a cut at a third"));
  EXPECT_TRUE(has(text, "setups of one force: A, B"));
  EXPECT_TRUE(has(text, "TANGENTIAL  3 of c0"));
  EXPECT_TRUE(has(text, "condition 12.35"));
  EXPECT_TRUE(has(text, "up to 1.75 um per um"));
  EXPECT_FALSE(has(text, "WARNINGS"));
}

TEST(ChuckText, AGraphTellsItsPolynomialAndSteps) {
  auto result = ordered_json::parse(R"({"graph": {
    "coefficients": [0.001, -2e-5, 3e-7], "u_coefficients": [0.0001, 1e-6, 3e-8],
    "steps": [{"after_mm": 70, "before_mm": 75, "height_mm": 0.012, "u_mm": 0.0004,
               "p": 0.00012345}],
    "r2": 0.99512, "r2_as_measured": 0.9, "s_mm": 0.0015, "degrees_of_freedom": 25},
    "warnings": []})");
  const auto text = chuck_text(result);
  EXPECT_TRUE(has(text, "R^2 0.9951 (0.9000 as measured), scatter 1.50 um"));
  EXPECT_EQ(line(text, "z"), (Words{"z", "-2e-05", "1e-06", "5.0", "mm/mm"}));
  EXPECT_EQ(line(text, "z^2"), (Words{"z^2", "3e-07", "3e-08", "10.0", "mm/mm^2"}));
  EXPECT_TRUE(has(text, "of 12.00 um (std. error 0.40) between z = 70.00 and 75.00 mm"));
  EXPECT_TRUE(has(text, "by chance: p = 0.00012\n"));
  result["graph"]["steps"] = ordered_json::array();
  EXPECT_TRUE(has(chuck_text(result), "no step of the carriage"));
}

TEST(ChuckText, WhatIsMissingLeavesItsLineOut) {
  EXPECT_NO_THROW(chuck_text(ordered_json::object()));
  auto bare = fitted();
  bare["radial"] = {{"u", nullptr}, {"offsets", {{{"setup", 3}}}}};
  bare["predictions"] = {ordered_json::object()};
  EXPECT_FALSE(has(chuck_text(bare), "nan"));
}

}  // namespace
}  // namespace turnwright::report::chuck_text_test
