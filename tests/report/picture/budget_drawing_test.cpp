#include "report/picture/budget_drawing.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <regex>

#include "report/text/stack.hpp"

namespace turnwright::report::budget_drawing_test {
namespace {

// 20 um: 8 of deflection, 4 left, so 8 by all else, whose own shares are 4, 3 and 9.
TEST(Stack, AddsUpToTheWidth) {
  const Stack s =
      stack(20, 4, 1, {{"deflection", 8}, {"machine", 4}, {"drift", 3}, {"wear", 9}});
  double sum = s.left_um;
  for (const auto& [source, um] : s.slices) sum += um;
  EXPECT_NEAR(sum, 20, 1e-12);
  EXPECT_NEAR(s.slices[0].second, 8, 1e-12);
  EXPECT_NEAR(s.slices[1].second, 2, 1e-12);
  EXPECT_NEAR(s.slices[3].second, 4.5, 1e-12);
}

TEST(Stack, OfASizeHasItsMarginAtBothLimits) {
  const Stack s = stack(20, 4, 2, {{"deflection", 8}, {"machine", 4}});
  EXPECT_NEAR(s.left_um, 8, 1e-12);
  EXPECT_NEAR(s.slices[1].second, 4, 1e-12);
}

TEST(Stack, OfWhatTheCutHasNoPartInKeepsItsShares) {
  const Stack s = stack(10, -2, 1, {{"machine", 9}, {"measurement", 3}});
  EXPECT_NEAR(s.left_um, -2, 1e-12);
  EXPECT_NEAR(s.slices[0].second, 9, 1e-12);
  EXPECT_TRUE(stack(10, 10, 1, {}).slices.empty());
}

TEST(Stack, SourcesComeOnceAndOnlyIfTheyTake) {
  const std::vector<Stack> two = {stack(10, 1, 1, {{"deflection", 1}, {"machine", 0}}),
                                  stack(10, 1, 1, {{"drift", 1}, {"deflection", 1}})};
  EXPECT_EQ(sources(two), (std::vector<std::string>{"deflection", "drift"}));
}

planning::ProcessPlan plan() {
  planning::ToleranceResult t;
  t.id = "t<1>";
  t.kind = part::ToleranceKind::cylindricity;
  t.of = "d1";
  t.width_mm = 0.020;
  t.margin_mm = 0.004;
  t.predicted_mm = {0.008};
  t.allowed_mm = {0.012};
  t.shares = {{"deflection", 8}, {"machine", 8}};
  planning::ProcessPlan p;
  p.tolerances = {t};
  return p;
}

/// Left and right x of the first polygon of a class.
std::pair<double, double> bar(const std::string& svg, const std::string& css_class) {
  const std::regex shape("<polygon class=\"" + css_class +
                         "\" points=\"([0-9.]+),[0-9.]+ ([0-9.]+),");
  std::smatch found;
  if (!std::regex_search(svg, found, shape)) return {-1, -1};
  return {std::stod(found[1]), std::stod(found[2])};
}

TEST(BudgetDrawing, DrawsSharesEndToEndInTheWidth) {
  planning::PreparedPart p;
  p.drawing.name = "A & B";
  const auto svg = budget_drawing(p, plan());
  EXPECT_EQ(svg.rfind("<svg ", 0), 0u);
  EXPECT_NE(svg.find("A &amp; B"), std::string::npos);
  EXPECT_NE(svg.find("t&lt;1&gt;: cylindricity of d1"), std::string::npos);
  const auto frame = bar(svg, "frame"), cut = bar(svg, "share deflection"),
             machine = bar(svg, "share machine");
  EXPECT_NEAR(frame.second - frame.first, 100, 1e-9);
  EXPECT_NEAR(cut.first, frame.first, 1e-9);
  EXPECT_NEAR(cut.second - cut.first, 40, 1e-9);
  EXPECT_NEAR(machine.first, cut.second, 1e-9);
  EXPECT_NEAR(machine.second - machine.first, 40, 1e-9);
  EXPECT_EQ(svg, budget_drawing(p, plan()));
}

TEST(BudgetDrawing, ReachesOverTheEndWhereThereIsTooLittle) {
  auto over = plan();
  over.tolerances[0].margin_mm = -0.1;
  over.tolerances[0].shares = {{"deflection", 100}, {"unheard-of", 20}};
  const auto svg = budget_drawing({}, over);
  EXPECT_NEAR(bar(svg, "share deflection").second - bar(svg, "frame").first, 120, 1e-9);
  EXPECT_NE(svg.find(", over"), std::string::npos);
  EXPECT_NE(svg.find("unheard-of"), std::string::npos);
  over.tolerances[0].margin_mm = -1e-15;
  EXPECT_EQ(budget_drawing({}, over).find(", over"), std::string::npos);
}

TEST(BudgetDrawing, IsNoneOfAPlanWithoutTolerancesAndRefusesNoNumbers) {
  EXPECT_EQ(budget_drawing({}, {}), "");
  auto broken = plan();
  broken.tolerances[0].width_mm = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(budget_drawing({}, broken), std::domain_error);
}

}  // namespace
}  // namespace turnwright::report::budget_drawing_test
