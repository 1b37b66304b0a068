#include "report/page/stability_html.hpp"

#include <gtest/gtest.h>

#include <string>

namespace turnwright::report::stability_html_test {
namespace {

using nlohmann::ordered_json;

// Keys as in schemas/stability.result.json.
ordered_json result() {
  return ordered_json::parse(R"({
    "frf": [{"axis": "x", "lines": 31, "from_Hz": 700, "to_Hz": 1300,
      "modes": [{"frequency_Hz": 922.04, "u_frequency_Hz": 0.031, "damping_ratio": 0.03,
                 "u_damping_ratio": 0.0004, "stiffness_N_mm": 9000.4,
                 "u_stiffness_N_mm": 12, "mass_kg": 0.268, "stable_from_order": 7},
                {"frequency_Hz": 1100, "u_frequency_Hz": 9, "damping_ratio": 0.03,
                 "u_damping_ratio": 0.01, "stiffness_N_mm": 9e4,
                 "u_stiffness_N_mm": 3e4, "mass_kg": 1.9, "stable_from_order": null}],
      "explained": 0.99991, "relative_rest": 0.0095, "correlation": 0.04}],
    "force": {"hm_mm": 0.024, "Kt_MPa": 4512.3, "Kn_MPa": 2256.2},
    "speeds": [{"n_rpm": 6000, "limit_mm": 1.25, "crossings": [
        {"ap_mm": 1.25, "sense": "loss", "kind": "flip", "frequency_Hz": 900}]},
      {"n_rpm": 7000, "limit_mm": null, "crossings": []}],
    "best": {"n_rpm": 7000, "ap_mm": 5, "limited_by": "ap_max_mm", "limit_mm": null,
             "margin_mm": null, "speeds_judged": 33}, "magic_speeds": [],
    "points": [{"n_rpm": 6000, "ap_mm": 2, "unstable_multipliers": 1,
                "spectral_radius": 1.25, "stable": false}],
    "assumed": [{"pointer": "/a<b", "value": 1, "why": "default"}],
    "turnwright_version": "0.1.0", "request_digest": "0123456789abcdef"})");
}

TEST(StabilityHtml, SaysTheNumbersOfTheDocument) {
  const auto page = stability_html("part", result(),
                                   {{"stability.svg", "<svg>chart</svg>"},
                                    {"stabilisation-x.svg", "<svg>poles</svg>"}});
  EXPECT_EQ(page.rfind("<!doctype html>", 0), 0u);
  for (const char* what :
       {"7000 <small>1/min", "a larger ap_max_mm may allow more", "922.04 \u00b1 0.031",
        "9000.4 \u00b1 12", "31 lines from 700 to 1300 Hz", "99.991 %", "Kt 4512 MPa",
        "chatter at 900 Hz from 1.25 mm", "no chatter", "chatters</td>", "/a&lt;b",
        "data:image/svg+xml,%3Csvg%3Echart", "data:image/svg+xml,%3Csvg%3Epoles",
        "<td>from order 7</td>", "<td>never</td>", "request 0123456789abcdef"})
    EXPECT_NE(page.find(what), std::string::npos) << what;
  EXPECT_EQ(page.find("<b"), page.find("<body"));  // nothing unescaped
}

TEST(StabilityHtml, SaysWhatIsNotToBeTrustedOrNotTold) {
  auto r = result();
  r["warnings"] = {"/frf/0: the modes explain 62 % < 90 %"};
  r["undecided"] = {
      {{"pointer", "/points/1"}, {"n_rpm", 8000}, {"ap_mm", 1.5}, {"why", "on a limit"}}};
  const auto page = stability_html("part", r, {});
  EXPECT_NE(page.find("explain 62 % &lt; 90 %"), std::string::npos);
  EXPECT_NE(page.find("Undecided: 8000 1/min, 1.5"), std::string::npos);
  EXPECT_NE(page.find("(/points/1): on a limit."), std::string::npos);
}

TEST(StabilityHtml, LongTablesAreCutAndSaySo) {
  auto r = result();
  const auto speed = r["speeds"][0], point = r["points"][0];
  for (int i = 0; i < 400; ++i) {
    r["speeds"].push_back(speed);
    r["points"].push_back(point);
  }
  const auto page = stability_html("part", r, {});
  EXPECT_NE(page.find("One in 11 of 402 speeds"), std::string::npos);
  EXPECT_NE(page.find("The first 40 of 401."), std::string::npos);
  EXPECT_LT(page.size(), 60000u);
}

TEST(StabilityHtml, LacksWhatTheDocumentLacks) {
  const auto page = stability_html("part", ordered_json::object(), {});
  EXPECT_EQ(page.find("<h2"), std::string::npos);
}

}  // namespace
}  // namespace turnwright::report::stability_html_test
