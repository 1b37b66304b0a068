#include <gtest/gtest.h>

#include "../words.hpp"
#include "report/text/text.hpp"

namespace turnwright::report::review_text_test {
namespace {

using nlohmann::ordered_json;

// Keys as in schemas/review.result.json.
ordered_json answered() {
  return ordered_json::parse(R"({
    "name": "Pin", "status": "not-kept",
    "setups": [{"setup": 0, "cuts": [
      {"on": "d1", "kind": "rough", "tool": "R1", "f_mm_rev": 0.3, "vc_m_min": 180.4,
       "Fc_N": 1204, "largest_Fc_N": 1502, "Pc_kW": 3.62,
       "passes": [{"line": 7, "ap_mm": 2, "time_min": 0.1},
                  {"line": 9, "ap_mm": 1.5, "time_min": 0.1}],
       "limits": [{"name": "cutting force", "unit": "N", "value": 1204, "limit": 1000,
                   "at_most": true, "kept": false}]}],
      "minutes": {"cutting": 0.2, "air": 0.1, "tool_changes": 0.05, "edges": 0.01},
      "spent": {"time_min": 0.36, "cost": 0.5},
      "rapids_in_material": [{"line": 12, "mm": 0.31}],
      "unknown": [{"line": 3, "what": "#1=5", "why": "Variables are not followed."},
                  {"line": 4, "what": "#2=6", "why": "Variables are not followed."}],
      "taken": ["Blocks with a slash are taken as executed."]}],
    "sizes": [{"on": "d1", "diameter_mm": 30.1, "nominal_mm": 30,
               "allowed_mm": [29.98, 30.02], "beyond_mm": 0.08}],
    "not_predicted": ["setup 2 has no program"],
    "plan": {"spent": {"time_min": 0.3, "cost": 0.4}, "certificate": "global",
             "cost_per_part": 2.5, "lower_bound": 2.49}})");
}

TEST(ReviewText, TellsWhatIsNotKeptAndNotKnown) {
  const auto text = flat(review_text(answered()));
  for (const auto* line :
       {"\n 7 d1 rough R1 2 x 1.5 .. 2 0.3 180 1204 1502 3.62 12.0\n",
        "\n NOT KEPT cutting force: 1.2e+03 N where at most is 1e+03\n",
        "\n NOT KEPT line 12: a rapid goes 0.31 mm through material\n",
        "\n UNKNOWN Variables are not followed. (line 3 #1=5, line 4 #2=6)\n",
        "\n taken Blocks with a slash are taken as executed.\n",
        "\n d1 30.100 29.980 30.020\n",
        "\n beyond its limits by 0.08 mm until its offset is set\n",
        "\nTOLERANCES are not predicted\n setup 2 has no program\n",
        "nothing costs less than 2.49.\n"})
    EXPECT_TRUE(has(text, line)) << line << text;
}

TEST(ReviewText, ShowsPredictedTolerances) {
  auto result = answered();
  result["predicted"] = ordered_json::parse(R"({
    "tolerances": [{"id": "t1", "predicted_mm": 0.0012, "allowed_mm": 0.01,
                    "verdict": "met"},
                   {"id": "d1:diameter", "predicted_mm": [-0.01, 0.02],
                    "allowed_mm": [-0.02, 0.02], "verdict": "not-met"}],
    "limits": [{"operation": "s1-finish-d1", "name": "chatter", "value": 900,
                "unit": "N/mm", "limit": 700}]})");
  const auto text = flat(review_text(result));
  EXPECT_TRUE(has(text, "\n t1 0.0012 0.0100 met\n")) << text;
  EXPECT_TRUE(has(text, "\n d1:diameter -0.0100 .. 0.0200 -0.0200 .. 0.0200 not-met\n"))
      << text;
  EXPECT_TRUE(has(text, "\n NOT KEPT s1-finish-d1: chatter 900 N/mm, limit 700\n"))
      << text;
}

TEST(ReviewText, LacksNothingThatIsAbsent) {
  EXPECT_NO_THROW(review_text(ordered_json::object()));
}

}  // namespace
}  // namespace turnwright::report::review_text_test
