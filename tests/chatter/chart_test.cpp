#include "turnwright/chatter/chart.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "turnwright/base/cancelled.hpp"
#include "turnwright/chatter/limits.hpp"

namespace turnwright::chatter {
namespace {

ChartRequest turning(std::vector<double> speeds_rpm) {
  ChartRequest q;
  q.system.modes = {{Axis::x, 1000, 0.03, 5000}};
  q.system.exit_rad = 3;
  q.system.force = ConstantForce{2000};
  q.ap_max_mm = 5;
  q.speeds_rpm = std::move(speeds_rpm);
  return q;
}

std::vector<double> many_speeds() {
  std::vector<double> out;
  for (double n = 12000; n > 3000; n *= 0.99) out.push_back(n);
  return out;
}

// The lobes touch their common floor, 2 k zeta (1 + zeta)/K, and never go below it.
TEST(Chart, AbsoluteLimitIsTheFloorOfTheLobes) {
  const auto q = turning(many_speeds());
  const double floor = absolute_limit_mm(q.system);
  EXPECT_NEAR(floor, 2 * 5000 * 0.03 * 1.03 / 2000, 1e-15);
  double least = 5;
  for (const ChartSpeed& s : stability_chart(q).speeds)
    least = std::min(least, s.limits.limit_mm().value_or(5));
  EXPECT_GE(least, floor * (1 - 1e-9));
  EXPECT_LT(least, floor * 1.01);
}

TEST(Chart, TellsTheSpeedsInTheOrderAsked) {
  const auto q = turning({7000, 4000, 9000});
  std::size_t told = 0;
  const auto chart = stability_chart(q, {}, [&](std::size_t done, std::size_t all) {
    EXPECT_EQ(done, ++told);
    EXPECT_EQ(all, 3U);
  });
  EXPECT_EQ(told, 3U);
  ASSERT_EQ(chart.speeds.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const ChartSpeed& s = chart.speeds[i];
    EXPECT_EQ(s.index, i);
    EXPECT_EQ(s.limits.n_rpm, q.speeds_rpm[i]);
    EXPECT_EQ(s.limits.limit_mm(), speed_limits(q.system, q.speeds_rpm[i], 5).limit_mm());
    EXPECT_FALSE(s.uncertain);
  }
}

TEST(Chart, BestRemovesMostOfWhatTheMachineReaches) {
  auto q = turning(many_speeds());
  const auto most = [&](double up_to_rpm) {
    double all = 0;
    for (const ChartSpeed& s : stability_chart(q).speeds)
      if (s.limits.n_rpm <= up_to_rpm)
        all = std::max(all, s.limits.n_rpm * s.limits.limit_mm().value_or(5));
    return all;
  };
  auto best = stability_chart(q).best;
  ASSERT_TRUE(best);
  EXPECT_EQ(best->n_rpm * best->ap_mm, most(1e9));
  q.machine = SpeedRange{3500, 6000};
  best = stability_chart(q).best;
  ASSERT_TRUE(best);
  EXPECT_LE(best->n_rpm, 6000);
  EXPECT_EQ(best->n_rpm * best->ap_mm, most(6000));
  q.machine = SpeedRange{1, 2};
  EXPECT_FALSE(stability_chart(q).best);
}

TEST(Chart, BestIsLimitedByTheDepthAskedForWhereNothingChatters) {
  auto q = turning({7000, 9000});
  EXPECT_TRUE(stability_chart(q).best_is_limited_by_chatter);
  q.ap_max_mm = 0.9 * absolute_limit_mm(q.system);
  const auto chart = stability_chart(q);
  EXPECT_FALSE(chart.best_is_limited_by_chatter);
  EXPECT_EQ(chart.best->n_rpm, 9000);
  EXPECT_EQ(chart.best->ap_mm, *q.ap_max_mm);
}

// Between lobes, near 60 f/k: there the delay holds about k whole vibrations.
TEST(Chart, MagicSpeedsHoldWholeVibrations) {
  const double f_rpm = 60 * 1000 / (2 * M_PI);
  const auto magic = stability_chart(turning(many_speeds())).magic;
  ASSERT_EQ(magic.size(), 3U);  // k = 3, 2 and 1: 3183, 4775 and 9549/min
  for (const int k : {3, 2, 1})
    EXPECT_NEAR(magic[static_cast<std::size_t>(3 - k)].n_rpm, f_rpm / k,
                0.03 * f_rpm / k);
}

TEST(Chart, PointsAgreeWithTheLimits) {
  auto q = turning({5500, 8000});
  const auto limits = stability_chart(q).speeds;
  for (const ChartSpeed& s : limits)
    for (const double share : {0.98, 1.02})
      q.points.push_back({s.limits.n_rpm, share * *s.limits.limit_mm()});
  q.speeds_rpm.clear();
  const auto points = stability_chart(q).points;
  ASSERT_EQ(points.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(points[i].stable, i % 2 == 0);
    EXPECT_EQ(points[i].unstable, i % 2 == 0 ? 0 : 2);
    EXPECT_EQ(points[i].spectral_radius < 1, points[i].stable);
  }
}

TEST(Chart, LeavesWhenNobodyWaits) {
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(stability_chart(turning({7000}), stop.get_token()), Cancelled);
}

}  // namespace
}  // namespace turnwright::chatter
