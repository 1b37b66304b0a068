#include "turnwright/optimise/relaxation_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace turnwright::optimise {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

// f(x) = cos(3 x) + x/5 over [-4, 4], bounded by its steepest slope between the points of
// a grid.
Relaxed waves(const Box& box, double) {
  const auto f = [](double x) { return std::cos(3 * x) + x / 5; };
  const Interval x = box[0];
  double lower = kUnbounded, at = mid(x);
  for (int i = 0; i <= 64; ++i) {  // |f'| <= 3.2
    const double y = x.lo + width(x) * i / 64;
    if (f(y) - 3.2 * width(x) / 128 < lower) lower = f(at = y) - 3.2 * width(x) / 128;
  }
  return {lower, f(at), 0, at};
}

double least_on_grid() {
  double best = kUnbounded;
  for (int i = 0; i <= 800000; ++i) {
    const double x = -4 + 1e-5 * i;
    best = std::min(best, std::cos(3 * x) + x / 5);
  }
  return best;
}

const Box kBox{Interval(-4, 4), Interval(0), Interval(0)};

TEST(RelaxationSearch, BracketsTheLeastOfManyValleys) {
  const auto r = relaxation_search(kBox, kUnbounded, waves, {.gap = 1e-6});
  EXPECT_TRUE(r.complete);
  EXPECT_LE(r.lower_bound, least_on_grid());
  EXPECT_NEAR(r.upper_bound, least_on_grid(), 1e-6);
  EXPECT_LE(r.upper_bound - r.lower_bound, 1e-6);
  EXPECT_LT(r.nodes, 500);
}

TEST(RelaxationSearch, WhatItKnowsWhenTheBudgetEnds) {
  const auto r =
      relaxation_search(kBox, kUnbounded, waves, {.gap = 1e-9, .max_nodes = 4});
  EXPECT_FALSE(r.complete);
  EXPECT_EQ(r.nodes, 4);
  EXPECT_LE(r.lower_bound, least_on_grid());
}

TEST(RelaxationSearch, NothingAllowedAndNothingBetter) {
  const auto nothing = relaxation_search(kBox, kUnbounded, [](const Box&, double) {
    return Relaxed{kUnbounded, kUnbounded, 0, 0};
  });
  EXPECT_EQ(nothing.lower_bound, kUnbounded);
  EXPECT_EQ(nothing.upper_bound, kUnbounded);
  const auto known = relaxation_search(kBox, -5, waves);
  EXPECT_EQ(known.upper_bound, -5);
  EXPECT_EQ(known.nodes, 1);
}

}  // namespace
}  // namespace turnwright::optimise
