#include <gtest/gtest.h>

#include <sstream>

#include "../words.hpp"
#include "report/text/text.hpp"

namespace turnwright::report::thermal_text_test {
namespace {

using nlohmann::ordered_json;

// Keys as in schemas/thermal.result.json.
ordered_json answered() {
  return ordered_json::parse(R"({
    "choice": {"lags": 2, "by": "cross-validation", "one_lag_um": 11.234,
               "two_lags_um": 7.754},
    "parameters": [
      {"name": "tau_1_s", "value": 1983.4, "found": "inside", "ill_determined": false,
       "u": 120.4},
      {"name": "K_1_um", "value": -33.9, "found": "inside", "ill_determined": true,
       "u": 40},
      {"name": "tau_amb_s", "value": 11562000, "found": "at-upper-bound",
       "ill_determined": true},
      {"name": "b_um_K", "value": 29.8, "found": "unknown", "ill_determined": true},
      {"name": "p", "value": 2, "found": "given", "ill_determined": false}],
    "fitted": {"rows": 1928, "rms_um": 2.707, "mean_um": 0, "largest_um": 9.5},
    "autocorrelation": 0.98312,
    "held_out": {"rows": 851, "rms_um": 4.51, "mean_um": -1.5, "largest_um": 12.25},
    "network": {"rms_um": 1.62, "held_out": {"rows": 851, "rms_um": 15.3, "mean_um": 2,
                "largest_um": 40}, "held_out_inside": {"rows": 0}},
    "warnings": ["p: nothing in the log depends on it"]})");
}

TEST(ThermalText, ParametersHaveTheirStanding) {
  const auto text = flat(thermal_text(answered()));
  EXPECT_TRUE(has(text,
                  "2 lag(s) of the spindle, chosen by blocks left out: RMS 11.23 um "
                  "with one, 7.75 um"));
  EXPECT_TRUE(has(text, "\n tau_1 1983 1.2e+02 s\n"));
  EXPECT_TRUE(has(text, "\n K_1 -33.9 40 um ill-determined\n"));
  EXPECT_TRUE(has(text, "\n tau_amb 1.156e+07 - s at-upper-bound\n"));
  EXPECT_TRUE(has(text, "\n b 29.8 - um/K nothing depends on it\n"));
  EXPECT_TRUE(has(text, "\n p 2 - given\n"));
  EXPECT_TRUE(has(text, "\n - p: nothing in the log depends on it\n"));
}

TEST(ThermalText, TheNetworkStandsBesideTheModel) {
  auto result = answered();
  const auto text = flat(thermal_text(result));
  EXPECT_TRUE(has(text, "\n model, rows fitted 1928 2.71 0.00 9.50\n"));
  EXPECT_TRUE(has(text, "\n model, held out 851 4.51 -1.50 12.25\n"));
  EXPECT_TRUE(has(text, "\n network, rows fitted 1928 1.62 - -\n"));
  EXPECT_TRUE(has(text, "\n network, held out 851 15.30 2.00 40.00\n"));
  EXPECT_TRUE(has(text, "\n network, held out but like rows fitted 0 - - -\n"));
  EXPECT_TRUE(has(text, "residuals 0.983:"));
  result.erase("network");
  EXPECT_FALSE(has(thermal_text(result), "network"));
}

TEST(ThermalText, WhyThisNumberOfLags) {
  auto result = answered();
  result["choice"] = {{"lags", 1}, {"by", "request"}};
  EXPECT_TRUE(has(thermal_text(result), "1 lag(s) of the spindle, as requested\n"));
  result["choice"]["by"] = "too-few-rows";
  EXPECT_TRUE(has(thermal_text(result), "as the rows are too few to choose\n"));
}

TEST(ThermalText, ALongShiftIsShownFromItsFirstToItsLastRow) {
  auto result = answered();
  auto& shift = result["shift"];
  for (int i = 0; i < 100; ++i) {
    shift["time_s"].push_back(60 * i);
    shift["drift_um"].push_back(0.25 * i);
    shift["u_um"].push_back(1.5);
  }
  shift["batch"] = {{"time_s", {1, 2, 3}},
                    {"range_um", 4.567},
                    {"between_offsets_um", 2.5},
                    {"largest_step_um", 0.75}};
  const auto text = flat(thermal_text(result));
  EXPECT_TRUE(has(text, "\n 0 0.00 1.50\n"));
  EXPECT_TRUE(has(text, "\n 5940 24.75 1.50\n"));
  EXPECT_TRUE(has(text,
                  "batch of 3 parts: drift ranges over 4.57 um, between two offsets "
                  "over 2.50 um;"));
  const auto shown = std::count(text.begin(), text.end(), '\n');
  EXPECT_LT(shown, 45);
}

TEST(ThermalText, WhatIsMissingLeavesItsLineOut) {
  EXPECT_NO_THROW(thermal_text(ordered_json::object()));
  auto result = answered();
  result["shift"] = {{"time_s", {1, 2}}, {"drift_um", {1}}, {"u_um", {"x"}}};
  EXPECT_FALSE(has(thermal_text(result), "nan"));
}

}  // namespace
}  // namespace turnwright::report::thermal_text_test
