#include "planning/surface/recipes.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "../parts.hpp"
#include "planning/preparation/assignment.hpp"

namespace turnwright::planning {
namespace {

// The recipes of the pin's thin end with a tool that may cut so deep.
std::vector<Recipe> of_depths(const catalogue::Range& ap_mm, std::size_t pieces = 0) {
  auto p = part(pin());
  auto& t = p.tools.front();
  t.re_mm = 0;
  t.ap_mm = ap_mm;
  t.chip.resize(pieces);
  const auto work = assign(p);
  const auto done = nothing_finished(p.drawing);
  const auto f = MachinedSurface::element(p, 0, Clamping::chuck, work.setups[0], done,
                                          work.setups[0].elements.front(), {});
  return recipes(p, f, {}, &t, &t);
}

int most_passes(const std::vector<Recipe>& all) {
  return std::ranges::max_element(all, {}, &Recipe::rough_passes)->rough_passes;
}

// Corners without a radius and depths near nothing let a surface take any number of passes.
TEST(Recipes, HaveAThousandPassesAtMost) {
  EXPECT_EQ(most_passes(of_depths({1e-8, 5})), 1000);
  EXPECT_TRUE(of_depths({1e-8, 1e-7}).empty());
}

// A face is made by any number of finishing passes.
TEST(Recipes, OfAFaceHaveAThousandPassesAtMost) {
  auto p = part(pin());
  const auto f =
      MachinedSurface::end_face(p, 0, nothing_finished(p.drawing), GivenConditions{});
  auto& t = p.tools.front();
  t.re_mm = 0;
  const auto in_passes = [&](double passes) {
    t.ap_mm = {1e-8, f.stock_mm() / passes};
    return recipes(p, f, {}, nullptr, &t);
  };
  ASSERT_FALSE(in_passes(999.9).empty());
  EXPECT_EQ(in_passes(999.9).front().finish_passes, 1000);
  EXPECT_TRUE(in_passes(1000.1).empty());
}

// Every number of passes comes with every piece of both windows.
TEST(Recipes, OfManyPiecesHaveFewerNumbersOfPasses) {
  const auto all = of_depths({1e-8, 5}, 30);
  EXPECT_LT(all.size(), 250'000U);
  EXPECT_GT(most_passes(all), 10);
}

}  // namespace
}  // namespace turnwright::planning
