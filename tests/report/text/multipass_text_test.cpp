#include <gtest/gtest.h>

#include "../words.hpp"
#include "report/text/text.hpp"

namespace turnwright::report::multipass_text_test {
namespace {

using nlohmann::ordered_json;

// Keys as in schemas/multipass.result.json.
ordered_json passes_answered() {
  return ordered_json::parse(R"({
    "status": "ok", "UC": 2.03507981, "n": 1,
    "rough": {"V": 109.6631, "f": 0.565529, "d": 3, "T": 45, "F_kgf": 200, "P_kW": 4.216,
              "Q_degC": 853.7},
    "finish": {"V": 169.9785, "f": 0.226212, "d": 3, "T": 25, "F_kgf": 100.6,
               "P_kW": 3.286, "Q_degC": 846},
    "active": ["rough:FU", "k4"],
    "constraints": [
      {"name": "rough:PU", "value": 4.2, "limit": 5, "margin": 0.17, "binding": false,
       "price": 0},
      {"name": "rough:FU", "value": 200, "limit": 200, "margin": 0, "binding": true,
       "price": -0.5}],
    "certificate": {"kind": "global", "lower_bound": 2.0350796, "gap": 1e-7, "nodes": 31},
    "per_pass_count": [
      {"n": 1, "UC": 2.03507981, "status": "optimal", "lower_bound": 2.0350796},
      {"n": 2, "UC": null, "status": "infeasible"}]})");
}

TEST(MultipassText, HasCostBoundConditionsAndWhatBinds) {
  const auto text = flat(multipass_text(passes_answered()));
  EXPECT_TRUE(has(text, "\ncost 2.0350798 per piece\n"));
  EXPECT_TRUE(has(text, "\npasses 1 roughing, 1 finishing\n"));
  EXPECT_TRUE(has(text, "\nbound 2.0350796: no allowed point costs less\n"));
  EXPECT_TRUE(has(text, "\n rough 109.663 0.565529 3 45 200 4.216 853.7\n"));
  EXPECT_TRUE(has(text, "\n finish 169.978 0.226212 3 25 100.6 3.286 846\n") ||
              has(text, "\n finish 169.979 0.226212 3 25 100.6 3.286 846\n"));
  EXPECT_TRUE(has(text, "\n rough:FU 200 200 -4.654\n"));  // 1.1^-0.5 = 0.95346
  EXPECT_FALSE(has(text, "rough:PU"));
  EXPECT_TRUE(has(text, "\n 1 2.0350798 2.0350796 optimal\n"));
  EXPECT_TRUE(has(text, "\n 2 - - infeasible\n"));
}

TEST(MultipassText, TellsAConflictAndItsRelief) {
  const auto text = flat(multipass_text(ordered_json::parse(R"({
    "status": "infeasible", "UC": null, "conflicts": ["rough:V_min", "rough:VrU"],
    "relax": [{"limit": "rough:V_min", "now": 50, "needed": 40},
              {"limit": "rough:VrU", "now": 40, "needed": null}],
    "per_pass_count": [{"n": 1, "UC": null, "status": "infeasible"}]})")));
  EXPECT_TRUE(has(text, "\nstatus infeasible\n"));
  EXPECT_TRUE(has(text, "\nCONFLICT rough:V_min, rough:VrU cannot be kept together"));
  EXPECT_TRUE(has(text, "\n rough:V_min 50 40\n"));
  EXPECT_TRUE(has(text, "\n rough:VrU 40 never suffices\n"));
  EXPECT_FALSE(has(text, "CONDITIONS"));
}

TEST(MultipassText, ASinglePassHasSpeedAndFeed) {
  const auto text = flat(multipass_text(ordered_json::parse(R"({
    "status": "ok", "UC": 1.05451, "V": 290.1, "f": 0.005, "active": [],
    "constraints": [], "certificate": {"kind": "global", "lower_bound": 1.05451,
    "gap": 0, "nodes": 1}})")));
  EXPECT_TRUE(has(text, "\n 290.1 0.005\n"));
  EXPECT_FALSE(has(text, "passes"));
}

TEST(MultipassText, LacksWhatTheResultLacks) {
  EXPECT_TRUE(has(multipass_text(ordered_json::object()), "MULTI-PASS TURNING\n"));
}

}  // namespace
}  // namespace turnwright::report::multipass_text_test
