#include <gtest/gtest.h>

#include "../words.hpp"
#include "report/picture/run_drawing.hpp"
#include "report/text/text.hpp"

namespace turnwright::report::learn_text_test {
namespace {

using nlohmann::ordered_json;

// Keys as in schemas/learn.result.json.
ordered_json answered() {
  return ordered_json::parse(R"({
    "confidence": 0.95,
    "characteristics": [{
      "id": "seat", "nominal_mm": 30, "lower_mm": 29.98, "upper_mm": 30.02, "n": 3,
      "left_out": 1,
      "mean_mm": {"value": 30.001, "u": 0.001, "lower": 29.999, "upper": 30.003},
      "wear_mm_part": {"value": 0.00025, "u": 0.0001, "lower": 0.0001, "upper": 0.0004},
      "edges": {"count": 2, "jumps": [
        {"to": "b", "value": -0.004, "u": 0.001, "lower": -0.006, "upper": -0.002}]},
      "within": {"s_mm": {"value": 0.002, "u": 0.0002, "lower": 0.0015, "upper": 0.003},
        "Cp": {"value": 3.333, "u": 0.1, "lower": 2.2, "upper": 4.4},
        "Cpk": {"value": 3.167, "u": 0.1, "lower": 2.1, "upper": 4.2}},
      "advice": {"target_mm": 30,
        "expected_mm": {"value": 30.004, "u": 0.001, "lower": 30.002, "upper": 30.006},
        "correction_mm": {"value": -0.004, "u": 0.001, "lower": -0.006, "upper": -0.002},
        "worthwhile": true, "per_part_mm": 0.00025, "room_mm": 0.014, "due_in_parts": 56,
        "edge_due_in_parts": 12},
      "not_identified": ["drift: all parts have one time"],
      "values": [{"part": "1", "value_mm": 30.001, "edge": "a", "fitted_mm": 30},
                 {"part": "2", "value_mm": 30.003, "edge": "a", "fitted_mm": 30.002},
                 {"part": "3", "value_mm": 1.1811, "edge": "a"},
                 {"part": "4", "value_mm": 29.999, "edge": "b", "fitted_mm": 29.998}]}],
    "left_out": [{"at": "/rows/2", "part": "3", "characteristic": "seat",
      "value_mm": 1.1811, "kind": "inch", "sentence": "part 3, seat: 1.1811 mm is in inches"}],
    "warnings": ["the scatter is not normal"]})");
}

TEST(LearnText, CharacteristicsHaveIntervalsAndAdvice) {
  const auto text = flat(learn_text(answered()));
  for (const auto* line :
       {"\nseat 3 values, 1 left out\n", "\n mean 30.00100 29.99900 30.00300 mm\n",
        "\n s from part to part 2.00 1.50 3.00 um\n", "\n Cpk 3.17 2.10 4.20\n",
        "\n wear 0.250 0.100 0.400 um per part\n",
        "\n jump to edge b -4.00 -6.00 -2.00 um\n",
        "\n ADVICE correct the size by -4.0 um before the next part, standard "
        "uncertainty "
        "1.0 um; the next\n",
        "\n correction is due after 56 parts more; the edge is changed in 12 parts\n",
        "\n not told drift: all parts have one time\n",
        "\nLEFT OUT\n part 3, seat: 1.1811 mm is in inches\n",
        "\n - the scatter is not normal\n"})
    EXPECT_TRUE(has(text, line)) << line << text;
}

TEST(LearnText, SaysWhenACorrectionIsNotWorthwhileOrHelpsNothing) {
  auto result = answered();
  auto& advice = result["characteristics"][0]["advice"];
  advice["worthwhile"] = false;
  advice["due_in_parts"] = 0;
  advice["room_mm"] = 0.002;
  EXPECT_TRUE(has(flat(learn_text(result)), "due at the next part"));
  advice["room_mm"] = -0.002;
  const auto text = flat(learn_text(result));
  EXPECT_TRUE(has(text, "better wait"));
  EXPECT_TRUE(has(text, "three standard"));
}

TEST(LearnText, OfManyEdgesTheLastAreShown) {
  auto result = answered();
  auto& jumps = result["characteristics"][0]["edges"]["jumps"];
  for (int i = 0; i < 20; ++i) {
    jumps.push_back(jumps[0]);
    jumps.back()["to"] = std::to_string(i);
  }
  const auto text = flat(learn_text(result));
  EXPECT_FALSE(has(text, "\n jump to edge 11 "));
  EXPECT_TRUE(has(text, "\n jump to edge 12 "));
  EXPECT_TRUE(has(text, "\n jump to edge 19 "));
}

TEST(LearnText, FactorsStandBeforeAndAfter) {
  auto result = answered();
  result["factors"] = ordered_json::parse(R"([
    {"name": "passive_force", "unit": "-", "prior": {"value": 1, "u": 0.25},
     "identified": false, "not_identified": "stays at its prior; it takes two diameters"},
    {"name": "rechucking", "by": "soft_jaws", "unit": "um", "prior": {"value": 2, "u": 1},
     "identified": true,
     "posterior": {"value": 4.567, "u": 0.4, "lower": 3.9, "upper": 5.4}}])");
  result["documents"] = {{"machine", {{"id", "l1"}}}};
  const auto text = flat(learn_text(result));
  EXPECT_TRUE(has(text,
                  "\n passive force 1 0.25 - - - -\n stays at its prior; it takes two "
                  "diameters\n"))
      << text;
  EXPECT_TRUE(has(text, "\n rechucking by soft_jaws 2 1 4.57 3.9 5.4 um\n"));
  EXPECT_TRUE(has(text, "documents of the result (-o) for the next plan: machine\n"));
}

// The frame is 24 .. 184 mm wide and has one place more than values: the edge changes
// between places 3 and 4 of 5, at 24 + 160 3.5/5 = 136.
TEST(RunDrawing, ShowsEveryValueTheChangeOfTheEdgeAndTheAdvice) {
  const auto figures = run_drawings(answered());
  ASSERT_EQ(figures.size(), 1U);
  EXPECT_EQ(figures[0].file, "run-1.svg");
  const auto& svg = figures[0].svg;
  EXPECT_TRUE(has(svg, "<title>Run of seat</title>"));
  EXPECT_TRUE(
      has(svg, "<line class=\"leader\" x1=\"136.000\" y1=\"22.000\" x2=\"136.000\""));
  EXPECT_TRUE(has(svg, "class=\"accent\"")) << "the part that was left out";
  EXPECT_TRUE(has(svg, "next part: correct by -4 um (u 1 um); again after 56 parts"));
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(RunDrawing, WithoutStatisticsThereIsAPictureStill) {
  auto result = answered();
  auto& c = result["characteristics"][0];
  for (const auto* key : {"within", "advice"}) c.erase(key);
  for (auto& v : c["values"]) v.erase("fitted_mm");
  EXPECT_TRUE(has(run_drawings(result)[0].svg, "</svg>"));
}

}  // namespace
}  // namespace turnwright::report::learn_text_test
