// The search alone, against lattices that know nothing of it.
#include "planning/auxiliary/milled_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace turnwright::planning {
namespace {

chatter::Lobes lobes(std::mt19937_64& draw, double immersion) {
  std::uniform_real_distribution<double> u(0, 1);
  chatter::System s;
  for (const auto axis : {chatter::Axis::x, chatter::Axis::y})
    s.modes.push_back({axis, 2 * std::numbers::pi * (500 + 1500 * u(draw)),
                       0.02 + 0.04 * u(draw), 5000 + 15000 * u(draw)});
  s.teeth = 1 + static_cast<int>(4 * u(draw));
  const auto arc = chatter::down_milling(immersion);
  s.entry_rad = arc.entry_rad;
  s.exit_rad = arc.exit_rad;
  s.force = chatter::LinearForce{1, 0.2 + 0.4 * u(draw)};
  return chatter::Lobes({s});
}

MilledCase some_case(const chatter::Lobes& l, int passes, double slope, double limit) {
  MilledCase c;
  c.lobes = &l;
  c.n_min_rpm = 1500;
  c.n_max_rpm = 6000;
  c.caps = {{0.06, 0}, {limit / passes * std::pow(3000, slope), -slope}};
  c.caps[1].c *= 0.06 * 5;
  c.fz_min_mm = 0.01;
  c.path_mm = 40.0 * passes;
  c.teeth = l.systems()[0].teeth;
  c.minute = 1.5;
  c.edge = 35;
  c.besides = 0.01 * passes;
  c.T0_min = 60;
  c.n0_rpm = 4000;
  c.nT = 0.25;
  c.mc = 0.25;
  c.load = 5.0 / passes * 1.2 * 1600 * std::pow(0.64, -0.25);
  c.speed_margin = 0.02;
  return c;
}

// (2) on a lattice of its own.
bool stable(const MilledCase& c, double n) {
  const double W = load_N_mm(c, feed_mm(c, n));
  for (int k = -7; k <= 7; ++k)
    for (const auto* l : {c.lobes, c.between})
      if (l && l->stable_to_N_mm(n * (1 + c.speed_margin * k / 7), W) < W * (1 - 1e-12))
        return false;
  return true;
}

TEST(MilledSearch, NothingOnALatticeIsCheaper) {
  std::mt19937_64 draw(7);
  for (const double immersion : {1.0, 0.1}) {
    const auto l = lobes(draw, immersion), on_the_way = lobes(draw, 1);
    for (const double slope : {0.0, 1.6}) {
      std::vector<MilledCase> cases;
      for (const int passes : {1, 3, 8, 14}) {
        cases.push_back(some_case(l, passes, slope, 1));
        cases.back().between = &on_the_way;
      }
      const auto best = cheapest(cases);
      double least = std::numeric_limits<double>::infinity();
      for (const auto& c : cases)
        for (int k = 0; k <= 50; ++k) {
          const double n = c.n_min_rpm * std::pow(c.n_max_rpm / c.n_min_rpm, k / 50.0);
          if (feed_mm(c, n) < c.fz_min_mm || cost(c, n) >= least || !stable(c, n))
            continue;
          least = cost(c, n);
        }
      ASSERT_EQ(best.found, std::isfinite(least)) << immersion << ' ' << slope;
      if (!best.found) continue;
      EXPECT_TRUE(best.proved);
      EXPECT_LE(best.lower_bound, least);
      EXPECT_LE(best.cost, least * (1 + 1e-5)) << immersion << ' ' << slope;
      EXPECT_LE(best.cost - best.lower_bound, 1e-4 * best.cost);
      EXPECT_TRUE(stable(cases[best.index], best.n_rpm)) << immersion << ' ' << slope;
    }
  }
}

TEST(MilledSearch, WhereNothingIsStableThereIsNone) {
  std::mt19937_64 draw(3);
  const auto l = lobes(draw, 1);
  auto c = some_case(l, 1, 0, 1);
  c.load *= 1000;
  const auto best = cheapest({c});
  EXPECT_FALSE(best.found);
  EXPECT_TRUE(best.proved);
  EXPECT_FALSE(std::isfinite(best.lower_bound));
}

// Without chatter: a convex cost between the caps.
TEST(MilledSearch, IsTheEconomicSpeedWhereEverythingIsStable) {
  std::mt19937_64 draw(5);
  const auto l = lobes(draw, 1);
  auto c = some_case(l, 1, 0, 100);
  c.load = 1e-3;
  const auto best = cheapest({c});
  // d/dn of (1/n)(minute + edge/T0 (n/n0)^4) is zero.
  const double n = c.n0_rpm * std::pow(c.minute * c.T0_min / (3 * c.edge), 0.25);
  ASSERT_TRUE(best.found);
  EXPECT_NEAR(best.n_rpm, n, 1e-3 * n);
  EXPECT_NEAR(best.cost, cost(c, n), 1e-9 * best.cost);
  EXPECT_NEAR(best.lower_bound, best.cost, 1e-9 * best.cost);
}

TEST(MilledSearch, AGivenSpeedIsTakenOrRefused) {
  std::mt19937_64 draw(9);
  const auto l = lobes(draw, 1);
  auto c = some_case(l, 20, 0, 1);
  c.load = 1;
  c.n_min_rpm = c.n_max_rpm = 3210;
  auto best = cheapest({c});
  ASSERT_TRUE(best.found);
  EXPECT_EQ(best.n_rpm, 3210);
  c.fz_min_mm = 0.0601;
  EXPECT_FALSE(cheapest({c}).found);
  c.fz_min_mm = 0.01;
  c.load = 1e9;
  EXPECT_FALSE(cheapest({c}).found);
}

TEST(MilledSearch, FeedTimeAndLifeAreTheirFormulas) {
  std::mt19937_64 draw(1);
  const auto l = lobes(draw, 1);
  const auto c = some_case(l, 2, 1, 1);
  const double n = 5000, fz = std::min(0.06, c.caps[1].c / n);
  EXPECT_NEAR(feed_mm(c, n), fz, 1e-15);
  EXPECT_NEAR(time_min(c, n), 80 / (fz * c.teeth * n), 1e-12);
  EXPECT_NEAR(life_min(c, n), 60 * std::pow(0.8, 4), 1e-12);
  EXPECT_NEAR(cost(c, n), time_min(c, n) * (1.5 + 35 / life_min(c, n)) + 0.02, 1e-12);
  EXPECT_NEAR(load_N_mm(c, fz), c.load * std::pow(fz, -0.25), 1e-9);
}

}  // namespace
}  // namespace turnwright::planning
