#include "report/picture/window_drawing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace turnwright::report::window_drawing_test {
namespace {

planning::OperationPlan operation() {
  planning::OperationPlan o;
  o.id = "s1-finish-d1";
  o.passes.push_back({.ap_mm = 0.5, .f_mm_rev = 0.2, .vc_m_min = 200});
  o.window = planning::OperatingWindow{
      5,
      {180, 220, 220, 180},
      {0.15, 0.15, 0.2, 0.2},
      {"least feed", "power", "largest feed", "cost <5 %"},
      {{"power", {220, 220}, {0.14, 0.21}}, {"grip", {1, 2}, {0.14, 0.21}}},
      {{"cost +2.5 %", {190, 195}, {0.15, 0.2}}}};
  return o;
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
    ++n;
  return n;
}

TEST(WindowDrawing, NamesEachLimitOnceAndLeavesOutWhatIsOutside) {
  const auto svg = window_drawing(operation());
  EXPECT_EQ(count(svg, "<svg "), 1u);
  EXPECT_NE(svg.find("s1-finish-d1: window of speed and feed"), std::string::npos);
  for (const auto* name :
       {"least feed", "power", "largest feed", "cost &lt;5 %", "cost +2.5 %"})
    EXPECT_EQ(count(svg, std::string("  ") + name + "</text>"), 1u) << name;
  EXPECT_EQ(svg.find("grip"), std::string::npos);
}

// 1.25 around 180 .. 220 on 22 .. 130 mm of paper: ln(200/144)/ln(275/144) of the way.
TEST(WindowDrawing, PutsTheOptimumWhereTheScaleSays) {
  const double x = 22 + 108 * std::log(200.0 / 144) / std::log(275.0 / 144);
  char middle[32];
  std::snprintf(middle, sizeof middle, "%.3f", x);
  EXPECT_NE(window_drawing(operation()).find(middle), std::string::npos) << middle;
}

TEST(WindowDrawing, EqualWindowsGiveEqualBytesAndNoneIsRefused) {
  EXPECT_EQ(window_drawing(operation()), window_drawing(operation()));
  auto without = operation();
  without.window.reset();
  EXPECT_THROW(window_drawing(without), std::domain_error);
}

}  // namespace
}  // namespace turnwright::report::window_drawing_test
