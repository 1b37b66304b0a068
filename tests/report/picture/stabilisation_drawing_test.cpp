#include "report/picture/stabilisation_drawing.hpp"

#include <gtest/gtest.h>

#include <string>

#include "svg_check.hpp"

namespace turnwright::report::stabilisation_drawing_test {
namespace {

using nlohmann::ordered_json;

ordered_json pole(int order, double f_Hz, const char* stable) {
  return {{"order", order},
          {"frequency_Hz", f_Hz},
          {"damping_ratio", 0.02},
          {"stable", stable}};
}

/// From 0 to 1520 Hz, 10 Hz a mm; orders to 42, 2 mm each.
ordered_json response() {
  return {
      {"axis", "y"},
      {"from_Hz", 0},
      {"to_Hz", 1520},
      {"modes",
       {{{"frequency_Hz", 500}, {"stable_from_order", 3}},
        {{"frequency_Hz", 900}, {"stable_from_order", nullptr}}}},
      {"stabilisation",
       {{"orders", 42},
        {"poles",
         {pole(2, 500, "no"), pole(3, 500, "frequency"), pole(4, 500, "damping"),
          pole(5, 500, "all")}},
        {"unfitted", {{{"frequency_Hz", 1200}}}},
        {"curve", {{"frequency_Hz", {100, 500, 1000}}, {"magnitude", {0.1, 1, 0}}}}}}};
}

int times(const std::string& text, const std::string& what) {
  int n = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
    ++n;
  return n;
}

TEST(StabilisationDrawing, MarksStandAtFrequencyAndOrder) {
  const std::string svg = stabilisation_drawing(response());
  EXPECT_EQ(times(svg,
                  "points=\"69.200,94.000 70.000,93.200 70.800,94.000 "
                  "70.000,94.800\"/>"),
            1);  // order 5
  EXPECT_EQ(times(svg, "<polygon class=\"stable\" points=\"69.200,96.000"), 1);
  EXPECT_EQ(times(svg, "<line class=\"thin\" x1=\"69.200\" y1=\"98.000\""), 1);
  EXPECT_EQ(times(svg, "<line class=\"thin\" x1=\"69.600\" y1=\"99.600\""), 1);
  EXPECT_EQ(times(svg, "<polygon class=\"best\""), 2);  // with the one of the key
}

TEST(StabilisationDrawing, TheCurveIsInDecibelsOfItsHighestLine) {
  const std::string svg = stabilisation_drawing(response());
  // 84 mm are 80 dB; silence is drawn at the lower end.
  EXPECT_EQ(times(svg, "points=\"30.000,41.000 70.000,20.000 120.000,104.000\""), 1);
}

TEST(StabilisationDrawing, ModesAreStrokesDashedIfNeverStable) {
  const std::string svg = stabilisation_drawing(response());
  const std::string ends = " y1=\"104.000\" x2=\"";
  EXPECT_EQ(times(svg, "<line class=\"hopf\" x1=\"70.000\"" + ends), 1);
  EXPECT_EQ(times(svg, "<line class=\"hidden\" x1=\"110.000\"" + ends), 1);
  EXPECT_EQ(times(svg, "<line class=\"fold\" x1=\"140.000\"" + ends), 1);
}

}  // namespace
}  // namespace turnwright::report::stabilisation_drawing_test
