#include "turnwright/chatter/chart.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "chatter/safe_cuts.hpp"
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
  q.margins = {0, 0};
  const auto most = [&](double up_to_rpm) {
    double all = 0;
    for (const ChartSpeed& s : stability_chart(q).speeds)
      if (s.limits.n_rpm <= up_to_rpm)
        all = std::max(all, s.limits.n_rpm * s.limits.limit_mm().value_or(5));
    return all;
  };
  auto best = stability_chart(q).best;
  ASSERT_TRUE(best);
  EXPECT_EQ(best->at.n_rpm * best->at.ap_mm, most(1e9));
  q.machine = SpeedRange{3500, 6000};
  best = stability_chart(q).best;
  ASSERT_TRUE(best);
  EXPECT_LE(best->at.n_rpm, 6000);
  EXPECT_EQ(best->at.n_rpm * best->at.ap_mm, most(6000));
  q.machine = SpeedRange{1, 2};
  EXPECT_FALSE(stability_chart(q).best);
}

/// The least first loss within 2 % of a speed, or 5 mm.
double least_within_2_percent(const ChartRequest& q, double n_rpm) {
  double least = 5;
  for (int i = -16; i <= 16; ++i)
    least = std::min(
        least,
        speed_limits(q.system, n_rpm * (1 + 0.02 * i / 16), 5).limit_mm().value_or(5));
  for (const double u : q.speeds_rpm)
    if (u >= 0.98 * n_rpm && u <= 1.02 * n_rpm)
      least = std::min(least, speed_limits(q.system, u, 5).limit_mm().value_or(5));
  return least;
}

TEST(Chart, BestKeepsTheMarginsAndNoSpeedHasABetter) {
  const auto q = turning(many_speeds());
  const auto best = stability_chart(q).best;
  ASSERT_TRUE(best);
  double most = 0, most_there = 0;
  for (const double n : q.speeds_rpm) {
    const double rate = n * least_within_2_percent(q, n) / 1.2;
    most = std::max(most, rate);
    if (n == best->at.n_rpm) most_there = rate;
  }
  EXPECT_NEAR(best->at.n_rpm * best->at.ap_mm / most, 1, 1e-9);
  EXPECT_NEAR(best->at.n_rpm * best->at.ap_mm / most_there, 1, 1e-9);
  EXPECT_EQ(best->limited_by, DepthEnd::chatter);
  EXPECT_GE(*best->limit_mm, 1.2 * best->at.ap_mm);
  EXPECT_EQ(best->speeds_judged, 32U + 4U);  // the chart has 0.99^2 to 1/0.99 of it
}

TEST(Chart, BestTellsTheSpeedsBetweenWhichItsDepthIsStable) {
  const auto q = turning(many_speeds());
  const auto best = stability_chart(q).best;
  ASSERT_TRUE(best && best->stable);
  const auto stable = [&](double n_rpm) {
    return !speed_limits(q.system, n_rpm, best->at.ap_mm).limit_mm();
  };
  for (const auto& [end, way] :
       {std::pair{best->stable->from_rpm, -1.0}, std::pair{best->stable->to_rpm, 1.0}}) {
    EXPECT_GE(way * (end / best->at.n_rpm - 1), 0.02);
    EXPECT_TRUE(stable(end));
    EXPECT_TRUE(!stable(end * (1 + 2e-3 * way)) ||
                end == best->at.n_rpm * (1 + 0.1 * way));
  }
  const double before = best->stable->from_rpm * (1 - 2e-3);
  const auto lost = speed_limits(q.system, before, best->at.ap_mm).crossings;
  ASSERT_FALSE(lost.empty());
  EXPECT_NEAR(*best->chatter_Hz / lost.front().frequency_Hz, 1, 0.1);
  // Of a depth that is stable at every speed: as far as was looked.
  auto low = q;
  low.ap_max_mm = 0.9 * absolute_limit_mm(q.system);
  const auto all = stability_chart(low).best;
  EXPECT_EQ(all->stable->from_rpm, all->at.n_rpm * 0.9);
  EXPECT_EQ(all->stable->to_rpm, all->at.n_rpm * 1.1);
}

// P = 2 pi n M, M in proportion to the depth.
TEST(Chart, BestKeepsPowerAndTorqueOfTheMachine) {
  auto q = turning(many_speeds());
  const auto free = stability_chart(q).best;
  ASSERT_TRUE(free);
  q.spindle = SpindleLoad{.torque_Nm_mm = 2, .power_kW = {}, .torque_Nm = {}};
  EXPECT_NEAR(q.spindle->power_at_kW({3000, 5}), 2 * M_PI * 50 * 10 / 1000, 1e-12);
  EXPECT_EQ(stability_chart(q).best->at.n_rpm, free->at.n_rpm);
  q.spindle->torque_Nm = 0.5;
  auto best = stability_chart(q).best;
  EXPECT_EQ(best->limited_by, DepthEnd::torque);
  EXPECT_EQ(best->at.ap_mm, 0.25);
  q.spindle->torque_Nm.reset();
  q.spindle->power_kW = 0.25;
  best = stability_chart(q).best;
  EXPECT_EQ(best->limited_by, DepthEnd::power);
  EXPECT_NEAR(q.spindle->power_at_kW(best->at), 0.25, 1e-12);
}

TEST(Chart, BestIsLimitedByTheDepthAskedForWhereNothingChatters) {
  auto q = turning({7000, 9000});
  EXPECT_EQ(stability_chart(q).best->limited_by, DepthEnd::chatter);
  q.ap_max_mm = 0.9 * absolute_limit_mm(q.system);
  const auto chart = stability_chart(q);
  EXPECT_EQ(chart.best->limited_by, DepthEnd::ap_max);
  EXPECT_EQ(chart.best->at.n_rpm, 9000);
  EXPECT_EQ(chart.best->at.ap_mm, *q.ap_max_mm / 1.2);
  EXPECT_FALSE(chart.best->limit_mm);
}

// A speed that cannot be searched rules out its neighbours within the margin of speed.
TEST(Chart, BestIsNotBesideASpeedThatIsUndecided) {
  const auto q = turning({});
  const auto search = [&](double n_rpm, double ap_mm) {
    return speed_limits(q.system, n_rpm, ap_mm);
  };
  std::vector<SpeedLimits> limits;
  for (const double n : {7000.0, 9000.0, 9100.0}) limits.push_back(search(n, 5));
  KnownLimits known{
      .speeds = {}, .ap_max_mm = 5, .margins = {}, .machine = {}, .spindle = {}};
  for (const SpeedLimits& l : limits) known.speeds.push_back({l.n_rpm, &l});
  EXPECT_EQ(SafeCuts(known, search, {}).best()->at.n_rpm, 9100);
  known.speeds[2].limits = nullptr;
  EXPECT_EQ(SafeCuts(known, search, {}).best()->at.n_rpm, 7000);
}

// Where other speeds take long, those of the chart alone are judged.
TEST(Chart, ManyModesAreJudgedAtTheSpeedsOfTheChart) {
  ChartRequest q;
  for (int i = 0; i < 7; ++i)
    q.system.modes.push_back({Axis::x, 4000 + 900.0 * i, 0.05, 2e4});
  q.system.teeth = 2;
  const Engagement cut = down_milling(0.2);
  q.system.entry_rad = cut.entry_rad;
  q.system.exit_rad = cut.exit_rad;
  q.system.force = LinearForce{600, 200};
  q.ap_max_mm = 0.5;
  q.speeds_rpm = {20000, 20100};
  q.points = {{20000, 0.1}, {20050, 0.1}};
  const auto chart = stability_chart(q);
  ASSERT_TRUE(chart.best);
  EXPECT_EQ(chart.best->speeds_judged, 2U);
  EXPECT_FALSE(chart.best->stable);
  EXPECT_TRUE(chart.points[0].margin);
  EXPECT_FALSE(chart.points[1].margin);
  q.system.modes.pop_back();
  EXPECT_EQ(stability_chart(q).best->speeds_judged, 34U);
}

// The same motion in t/tau: an error of all frequencies is one of the speed.
TEST(Chart, LimitsAreThoseOfSpeedOverFrequency) {
  auto q = turning({});
  const double limit = *speed_limits(q.system, 7000, 5).limit_mm();
  q.system.modes[0].wn_rad_s *= 1.02;
  EXPECT_NEAR(*speed_limits(q.system, 1.02 * 7000, 5).limit_mm() / limit, 1, 1e-9);
}

TEST(Chart, PointsTellTheirMarginAndTheNearestSpeedThatIsSafe) {
  auto q = turning(many_speeds());
  q.points = {{7000, 0.1}, {7000, 0.5}, {7000.5, 0.5}, {7000, 6}};
  const auto points = stability_chart(q).points;
  const auto lost = speed_limits(q.system, 7000, 5).crossings.front();
  EXPECT_EQ(*points[0].margin->limit_mm, lost.ap_mm);
  EXPECT_FALSE(points[0].margin->chatter_Hz);
  EXPECT_FALSE(points[0].margin->cure);
  EXPECT_EQ(*points[1].margin->chatter_Hz, lost.frequency_Hz);
  double nearest = 0;
  for (const double n : q.speeds_rpm)
    if (least_within_2_percent(q, n) >= 1.2 * 0.5 &&
        std::abs(std::log(n / 7000)) < std::abs(std::log(nearest / 7000)))
      nearest = n;
  for (const std::size_t i : {1U, 2U}) {
    ASSERT_TRUE(points[i].margin->cure);
    EXPECT_EQ(points[i].margin->cure->n_rpm, nearest);
    EXPECT_EQ(points[i].margin->cure->limit_mm,
              speed_limits(q.system, nearest, 5).limit_mm());
  }
  EXPECT_GT(*points[3].margin->chatter_Hz, 0);
  EXPECT_FALSE(points[3].margin->cure);  // deeper than was searched
  q.machine = SpeedRange{nearest * 1.001, 1e5};
  EXPECT_NE(stability_chart(q).points[1].margin->cure->n_rpm, nearest);
  q.ap_max_mm.reset();
  q.speeds_rpm.clear();
  EXPECT_FALSE(stability_chart(q).points[0].margin);
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
