#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "report/text/layout.hpp"
#include "report/text/text.hpp"

namespace turnwright::report::stability_text_test {
namespace {

using nlohmann::ordered_json;

// Keys as in schemas/stability.result.json.
ordered_json result() {
  return ordered_json::parse(R"({
    "frf": [{"axis": "x", "modes": [
      {"frequency_Hz": 922.04, "damping_ratio": 0.03, "stiffness_N_mm": 16000.4,
       "stable_from_order": 7}]}],
    "speeds": [{"n_rpm": 10600, "limit_mm": 1.442, "crossings": [
        {"ap_mm": 1.442, "sense": "loss", "kind": "flip", "frequency_Hz": 883},
        {"ap_mm": 2.74, "sense": "regain", "kind": "flip", "frequency_Hz": 883}]},
      {"n_rpm": 9200, "limit_mm": null, "crossings": []}],
    "best": {"n_rpm": 9200, "ap_mm": 3.43, "limited_by": "chatter", "limit_mm": 3.96,
             "margin_mm": 0.53, "stable_rpm": {"from": 9065.4, "to": 9473},
             "chatter_Hz": 774, "speeds_judged": 33, "removed_cm3_min": 10.1,
             "power_kW": 0.101, "torque_Nm": 0.105},
    "magic_speeds": [{"n_rpm": 9100, "ap_mm": 4.18}],
    "points": [
      {"n_rpm": 10000, "ap_mm": 3, "stable": false, "limit_mm": 2.52, "margin_mm": -0.48,
       "chatter_Hz": 833, "cure": {"n_rpm": 9400, "limit_mm": 3.56, "margin_mm": 0.56}},
      {"n_rpm": 10001, "ap_mm": 5, "stable": false, "limit_mm": 2.52, "margin_mm": -2.48,
       "chatter_Hz": 833, "cure": null},
      {"n_rpm": 9200, "ap_mm": 1, "stable": true, "limit_mm": 3.96, "margin_mm": 2.96},
      {"n_rpm": 9300, "ap_mm": 1, "stable": true, "limit_mm": null, "margin_mm": null},
      {"n_rpm": 10600, "ap_mm": 3, "stable": true, "limit_mm": 1.442, "margin_mm": -1.558},
      {"n_rpm": 9400, "ap_mm": 1, "stable": true}],
    "undecided": [{"pointer": "/speeds_rpm/2", "n_rpm": 1, "ap_mm": 6, "why": "too slow"}],
    "assumed": [{"pointer": "/speed_margin", "value": 0.02, "why": "usual"}],
    "warnings": ["/frf/0: noise"]})");
}

/// With single blanks in place of the ends of lines.
std::string unwrapped(const std::string& text) {
  std::istringstream in(text);
  std::string out, word;
  while (in >> word) out += word + ' ';
  return out;
}

TEST(StabilityText, TellsCutsInAMachinistsWords) {
  const auto text = unwrapped(stability_text(result()));
  for (const char* what :
       {"9200 1/min, 3.43 mm deep: removes 10.1 cm3/min with 0.101 kW and 0.105 Nm; "
        "deeper",
        "begin to chatter at 774 Hz within the margins", "stable up to 3.96 mm, a margin",
        "from 9065 to 9473 1/min.",
        "chatters at 833 Hz, from 2.52 mm on; at 9400 1/min it does not, margin 0.56 mm",
        "stable, margin 2.96 mm", "stable, and up to the largest depth asked for",
        "stable only above depths that chatter from 1.44 mm on",
        "chatter at 883 Hz from 1.44 mm, stable again from 2.74 mm", "no chatter",
        "9100 (4.18 mm)", "16000 7 ", "/speeds_rpm/2: 1 1/min, 6 mm: too slow",
        "/frf/0: noise", "/speed_margin = 0.02: usual"})
    EXPECT_NE(text.find(what), std::string::npos) << what << '\n' << text;
  EXPECT_NE(text.find("at none of the speeds asked for it would be stable"),
            std::string::npos)
      << text;
  EXPECT_EQ(text.find("multiplier"), std::string::npos);
}

TEST(StabilityText, TellsWhatEndsTheBestDepth) {
  auto r = result();
  for (const auto& [by, words] :
       {std::pair{"ap_max_mm", "a larger ap_max_mm may allow more"},
        std::pair{"machine_power_kW", "the machine's power ends the depth"},
        std::pair{"machine_torque_Nm", "the machine's torque ends the depth"}}) {
    r["best"]["limited_by"] = by;
    const auto text = unwrapped(stability_text(r));
    EXPECT_NE(text.find(words), std::string::npos) << text;
  }
  r["best"] = nullptr;
  EXPECT_NE(stability_text(r).find("none of the speeds"), std::string::npos);
}

TEST(StabilityText, TellsLimitsWithASwingingSpeed) {
  auto r = result();
  EXPECT_EQ(stability_text(r).find("SWINGING"), std::string::npos);
  r["speeds"][0]["varied"] = {
      {{"rva", 0.3}, {"rvf", 0.1}, {"limit_mm", 1.93}, {"relative_error", 1e-9}},
      {{"rva", 0.1}, {"rvf", 0.1}, {"why", "too long"}}};
  const auto text = unwrapped(stability_text(r));
  EXPECT_NE(text.find("10600 30 0.1 1.93 1.442"), std::string::npos) << text;
  EXPECT_NE(text.find("too long"), std::string::npos);
}

TEST(StabilityText, LongTablesAreCutAndSaySo) {
  auto r = result();
  const auto speed = r["speeds"][0], point = r["points"][0];
  for (int i = 0; i < 400; ++i) {
    r["speeds"].push_back(speed);
    r["points"].push_back(point);
  }
  const auto text = stability_text(r);
  EXPECT_NE(text.find("one in 17 of 402 speeds"), std::string::npos) << text;
  EXPECT_NE(text.find("the first 24 of 406"), std::string::npos);
}

TEST(StabilityText, LinesFitThePage) {
  const auto text = stability_text(result());
  for (std::size_t at = 0; at < text.size();) {
    const auto end = text.find('\n', at);
    EXPECT_LE(characters(text.substr(at, end - at)), kPageWidth);
    at = end + 1;
  }
  EXPECT_EQ(stability_text(ordered_json::object()), "STABILITY OF THE CUT\n");
}

}  // namespace
}  // namespace turnwright::report::stability_text_test
