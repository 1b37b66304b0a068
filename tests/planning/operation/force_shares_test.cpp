#include "planning/operation/force_shares.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "turnwright/base/units.hpp"

namespace turnwright::planning {
namespace {

using Box = std::array<Interval, 2>;  // of ln ap and ln f

cutting::Cut random_cut(std::mt19937& seed) {
  std::uniform_real_distribution<double> unit(0, 1);
  cutting::Cut c;
  c.kc = {1600, 0.25};
  c.thrust.edge_N_mm = 60 * unit(seed);
  c.corner = cutting::corner_of(0.4 + 0.8 * unit(seed),
                                units::rad_from_deg(60 + 30 * unit(seed)));
  return c;
}

Law constant_law(double p) {
  Law law;
  law.p.c = {p};
  law.q.c = {-0.1 * p};
  law.s.c = {0.02 * p};
  law.r.c = {1e-6 * p};
  return law;
}

// The errors of a slender part at three positions, after a pass at the same feed in which
// it yielded several times as much.
struct Positions {
  std::vector<Law> laws, laws_before;
  cutting::Cut cut;
  double ap_before_mm = 3;

  explicit Positions(std::mt19937& seed) : cut(random_cut(seed)) {
    std::uniform_real_distribution<double> unit(0, 1);
    const double p = std::pow(10, -5.5 + 1.2 * unit(seed));
    for (const double share : {1.0, 0.65, 0.4 + 0.2 * unit(seed)}) {
      laws.push_back(constant_law(share * p));
      laws_before.push_back(constant_law(5 * share * p));
    }
  }
  double error(std::size_t i, double ap, double f) const {
    const double before = yielding_mm(laws_before[i], cut, 1, ap_before_mm, f, 0);
    return yielding_mm(laws[i], cut, 1, ap, f, before);
  }
  double sum(const std::vector<std::pair<std::size_t, double>>& terms,
             const std::array<double, 2>& y) const {
    double all = 0;
    for (const auto& [i, weight] : terms)
      all += weight * error(i, std::exp(y[0]), std::exp(y[1]));
    return all;
  }
};

struct Enclosed {
  std::vector<Yielded<2>> errors;
  std::optional<ForceShares<2>> shares;
};

using Weighted = std::vector<std::pair<std::size_t, double>>;

Enclosed enclosed(const Positions& at, const Box& box, const LogDual<2>::Half& half) {
  const auto ap = LogDual<2>::variable(box[0], 0, half);
  const auto f = LogDual<2>::variable(box[1], 1, half);
  const auto F = cutting::forces_N(at.cut, ap, f);
  Enclosed all;
  const LogDual<2> one(1), ap_before(at.ap_before_mm);
  for (std::size_t i = 0; i < at.laws.size(); ++i) {
    const auto before = yielding_mm(at.laws_before[i], at.cut, one, ap_before, f, {0.0});
    all.errors.push_back(yielded(at.laws[i], at.cut, one, ap, f, before));
  }
  all.shares = ForceShares<2>::of(at.cut, ap, f, F, all.errors);
  return all;
}

Box random_box(std::mt19937& seed, double size = 1) {
  std::uniform_real_distribution<double> unit(0, 1);
  const double ap = std::log(0.3 + unit(seed)), f = std::log(0.08 + 0.2 * unit(seed));
  return {Interval(ap, ap + size * (0.05 + 0.25 * unit(seed))),
          Interval(f, f + size * (0.05 + 0.45 * unit(seed)))};
}

void expect_in(const Interval& x, double value, double slack) {
  EXPECT_LE(x.lo, value + slack);
  EXPECT_GE(x.hi, value - slack);
}

// A sum of errors and its slopes, by differences, lie in their enclosures at every point of
// the box.
TEST(ForceShares, SumsHoldThePointsOfTheirBoxWithTheSlopes) {
  std::mt19937 seed(31);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int trial = 0; trial < 200; ++trial) {
    const Positions at(seed);
    const Box box = random_box(seed, trial % 2 ? 1 : 1e-3);
    const LogDual<2>::Half half{width(box[0]) / 2, width(box[1]) / 2};
    const auto all = enclosed(at, box, half);
    ASSERT_TRUE(all.shares);
    for (const Weighted& terms :
         {Weighted{{0, 1}}, Weighted{{0, 1}, {1, -1}},
          Weighted{{0, unit(seed)}, {1, -unit(seed)}, {2, 2 * unit(seed) - 1}}}) {
      const auto sum = all.shares->sum(terms);
      for (int k = 0; k < 4; ++k) {
        const std::array y{box[0].lo + unit(seed) * width(box[0]),
                           box[1].lo + unit(seed) * width(box[1])};
        const double e = at.error(0, std::exp(y[0]), std::exp(y[1]));
        expect_in(sum.v, at.sum(terms, y), 1e-12 * std::abs(e));
        for (std::size_t j = 0; j < 2; ++j) {
          const double h = 1e-5;
          auto up = y, down = y;
          up[j] += h;
          down[j] -= h;
          const double slope = (at.sum(terms, up) - at.sum(terms, down)) / (2 * h);
          expect_in(sum.d[j], slope, 1e-6 * std::abs(e));
        }
      }
    }
  }
}

// Range of the difference of the first two errors over a grid of the box.
Interval difference_on_grid(const Positions& at, const Box& box) {
  constexpr int kPoints = 7;
  Interval range(kInfinity, -kInfinity);
  for (int i = 0; i < kPoints; ++i)
    for (int j = 0; j < kPoints; ++j) {
      const double ap = std::exp(box[0].lo + width(box[0]) * i / (kPoints - 1));
      const double f = std::exp(box[1].lo + width(box[1]) * j / (kPoints - 1));
      range = hull(range, Interval(at.error(0, ap, f) - at.error(1, ap, f)));
    }
  return range;
}

double median(std::vector<double> x) {
  const auto middle = x.begin() + static_cast<std::ptrdiff_t>(x.size() / 2);
  std::nth_element(x.begin(), middle, x.end());
  return *middle;
}

// Each error is enclosed as wide as the force varies, so the difference of enclosures is
// several times as wide as the difference.
TEST(ForceShares, EncloseADifferenceNearlyAsItIs) {
  std::mt19937 seed(32);
  std::vector<double> together_by, apart_by;  // enclosures over the true range
  for (int trial = 0; trial < 200; ++trial) {
    const Positions at(seed);
    const Box box = random_box(seed);
    const LogDual<2>::Half half{width(box[0]) / 2, width(box[1]) / 2};
    const auto all = enclosed(at, box, half);
    ASSERT_TRUE(all.shares);
    const Interval together = all.shares->sum({{0, 1}, {1, -1}}).v;
    const Interval apart = all.errors[0].e.v - all.errors[1].e.v;
    const double range = width(difference_on_grid(at, box));
    together_by.push_back(width(together) / range);
    apart_by.push_back(width(apart) / range);
  }
  EXPECT_LT(median(together_by), 1.8);
  EXPECT_GT(median(apart_by), 4);
}

// An edge of more than 90 deg pulls deep cuts in: there is no passive force to share.
TEST(ForceShares, ThereAreNoneWhereTheToolMayPull) {
  std::mt19937 seed(33);
  Positions at(seed);
  at.cut.corner = cutting::corner_of(0.4, units::rad_from_deg(95));
  const Box box{Interval(std::log(2.0), std::log(8.0)), Interval(std::log(0.1))};
  const LogDual<2>::Half half{width(box[0]) / 2, 0};
  const auto ap = LogDual<2>::variable(box[0], 0, half);
  const auto f = LogDual<2>::variable(box[1], 1, half);
  const auto F = cutting::forces_N(at.cut, ap, f);
  const auto e = yielded(at.laws[0], at.cut, LogDual<2>(1), ap, f, {0.0});
  EXPECT_FALSE(ForceShares<2>::of(at.cut, ap, f, F, {e}).has_value());
}

}  // namespace
}  // namespace turnwright::planning
