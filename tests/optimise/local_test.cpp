#include "turnwright/optimise/local.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "turnwright/base/dual.hpp"

namespace turnwright::optimise {
namespace {

using D2 = Dual<double, 2>;

// min c1/x + c2 x^3 + c3 x y + c4/y subject to x y <= limit: a geometric program.
template <class T>
T cost(const T& x, const T& y) {
  using std::pow;
  return 2.0 / x + 0.3 * pow(x, 3.0) + 0.5 * x * y + 1.0 / y;
}

Problem geometric(double limit) {
  Problem p;
  p.lower = {std::log(0.05), std::log(0.05)};
  p.upper = {std::log(20.0), std::log(20.0)};
  p.constraints = 1;
  p.evaluate = [limit](std::span<const double> y, Values& out) {
    const D2 a = exp(variable<double, 2>(y[0], 0)), b = exp(variable<double, 2>(y[1], 1));
    const D2 f = log(cost(a, b)), g = log(a * b) - std::log(limit);
    out.f = f.v;
    out.g[0] = g.v;
    for (std::size_t j = 0; j < 2; ++j) out.df[j] = f.d[j], out.dg[j] = g.d[j];
  };
  return p;
}

double best_on_grid(double limit) {
  double best = 1e300;
  const int n = 1500;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) {
      const double x = 0.05 * std::pow(400, double(i) / n);
      const double y = std::min(0.05 * std::pow(400, double(j) / n), limit / x);
      best = std::min(best, cost(x, y));
    }
  return std::log(best);
}

TEST(LocalMinimum, IsTheBestPointOfADenseGrid) {
  const std::vector<double> start{0, 0};
  for (const double limit : {0.2, 0.8, 50.0}) {
    const auto s = local_minimum(geometric(limit), start);
    ASSERT_EQ(s.status, Status::converged);
    EXPECT_LE(s.worst, 1e-10);
    const double grid = best_on_grid(limit);
    EXPECT_LE(s.f, grid + 1e-12);
    EXPECT_NEAR(s.f, grid, 2e-5);  // grid step 0.4 % in x: second order in the valley
  }
}

TEST(LocalMinimum, MultiplierIsTheSlopeOverTheLimit) {
  // d f*/d ln(limit) = -lambda: central difference of re-solved optima.
  const std::vector<double> start{0, 0};
  const double h = 1e-4;
  const auto f = [&](double limit) { return local_minimum(geometric(limit), start).f; };
  const auto s = local_minimum(geometric(0.8), start);
  const double slope = (f(0.8 * std::exp(h)) - f(0.8 * std::exp(-h))) / (2 * h);
  // Multipliers err by the first power of the point's error, sqrt(1e-13) and some.
  EXPECT_NEAR(s.multipliers[0], -slope, 1e-5);
  EXPECT_GT(s.multipliers[0], 0.1);
  EXPECT_NEAR(local_minimum(geometric(50), start).multipliers[0], 0, 1e-9);
}

TEST(LocalMinimum, ConvexBoundIsTightAtTheOptimumAndHoldsElsewhere) {
  std::mt19937 seed(3);
  std::uniform_real_distribution<double> unit(0, 1);
  auto p = geometric(0.8);
  const std::vector<double> start{0, 0};
  const auto s = local_minimum(p, start);
  Values v{0, {0, 0}, {0}, {0, 0}};
  p.evaluate(s.y, v);
  EXPECT_NEAR(convex_lower_bound(p, s.y, v, s.multipliers), s.f, 1e-7);
  for (int i = 0; i < 2000; ++i) {  // any point with any multiplier bounds the optimum
    std::vector<double> y(2);
    for (std::size_t j = 0; j < 2; ++j)
      y[j] = p.lower[j] + unit(seed) * (p.upper[j] - p.lower[j]);
    p.evaluate(y, v);
    EXPECT_LE(convex_lower_bound(p, y, v, std::vector<double>{3 * unit(seed)}), s.f);
  }
}

TEST(LocalMinimum, NeverCallsAForbiddenPointASolution) {
  auto p = geometric(0.8);
  p.lower = {1, 1};  // x y >= e^2 > 0.8 everywhere
  const std::vector<double> start{2, 2};
  const auto s = local_minimum(p, start);
  EXPECT_EQ(s.status, Status::no_feasible_point_met);
  const auto least = least_violation(p, start, 0.0);
  EXPECT_NEAR(least.f, 2 - std::log(0.8), 1e-9);  // at the corner (1, 1)
  EXPECT_NEAR(least.multipliers[0], 1, 1e-9);
}

TEST(LocalMinimum, ModelErrorsComeOutUnchanged) {
  auto p = geometric(0.8);
  int calls = 0;
  p.evaluate = [&calls, inner = p.evaluate](std::span<const double> y, Values& out) {
    if (++calls == 3) throw std::domain_error("h below the fitted range");
    inner(y, out);
  };
  const std::vector<double> start{0, 0};
  try {
    local_minimum(p, start);
    FAIL() << "the model error was swallowed";
  } catch (const std::domain_error& e) {
    EXPECT_STREQ(e.what(), "h below the fitted range");
  }
}

TEST(LocalMinimum, RefusesBoundsThatAreNone) {
  auto p = geometric(1);
  const std::vector<double> start{0, 0};
  p.lower[0] = std::nan("");
  EXPECT_THROW(local_minimum(p, start), std::domain_error);
  p = geometric(1);
  p.lower[0] = 30;
  EXPECT_THROW(local_minimum(p, start), std::domain_error);
  EXPECT_THROW(local_minimum(geometric(1), std::vector<double>{0}), std::domain_error);
}

}  // namespace
}  // namespace turnwright::optimise
