#include <gtest/gtest.h>

#include <string>

#include "report/text/text.hpp"

namespace turnwright::report::overhang_text_test {
namespace {

using nlohmann::ordered_json;

// Keys as in schemas/overhang.result.json.
TEST(OverhangText, TellsEachOverhang) {
  const auto result = ordered_json::parse(R"({
    "overhangs": [
      {"overhang_mm": 40, "tip": [{"axis": "x", "modes": [{"frequency_Hz": 503.04,
        "damping_ratio": 0.0332, "stiffness_N_mm": 13239.4}]}], "least_mm": 0.6881,
       "best": {"n_rpm": 15000, "ap_mm": 2.543},
       "points": [{"n_rpm": 10000, "ap_mm": 1, "stable": false, "chatter_Hz": 5054,
                   "limit_mm": 0.549, "margin_mm": -0.451}]},
      {"overhang_mm": 60, "tip": [{"axis": "x", "modes": []}], "why": "no modes found"}],
    "assumed": [{"pointer": "/spindle/0/pivot_mm", "value": "none", "why": "no tilt"}],
    "warnings": ["/spindle/0/frf: noise"]})");
  const auto text = overhang_text(result);
  for (const char* what :
       {"40           0.688       15000      2.54", "no modes found",
        "40 mm  10000 1/min, 1 mm: chatters at 5054 Hz, from 0.549 mm on", "503.0",
        "13239", "/spindle/0/frf: noise", "/spindle/0/pivot_mm = none: no tilt"})
    EXPECT_NE(text.find(what), std::string::npos) << what << '\n' << text;
}

TEST(OverhangText, LacksWhatTheDocumentLacks) {
  const auto text = overhang_text(ordered_json::object());
  EXPECT_EQ(text.find("MODES"), std::string::npos);
  EXPECT_EQ(text.find("REQUESTED"), std::string::npos);
}

}  // namespace
}  // namespace turnwright::report::overhang_text_test
