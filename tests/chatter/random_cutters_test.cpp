// Random cutters with each option and with all: what is told holds, and what is not told
// is refused speed by speed.  TURNWRIGHT_LONG_TESTS takes 25 cutters a feature.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstdlib>
#include <random>

#include "chatter/collocation/delay_map.hpp"
#include "slice_simulation.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/chatter/chart.hpp"
#include "turnwright/chatter/cutter_limits.hpp"
#include "turnwright/chatter/system.hpp"

namespace turnwright::chatter {
namespace {

using units::kPi;

enum class Feature { helix, pitches, runout, damping, all };
constexpr std::array kFeatures{Feature::helix, Feature::pitches, Feature::runout,
                               Feature::damping, Feature::all};

int cutters_a_feature() { return std::getenv("TURNWRIGHT_LONG_TESTS") ? 25 : 2; }

class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}
  double within(double from, double to) {
    return std::uniform_real_distribution<>(from, to)(random_);
  }
  int whole(int from, int to) {
    return std::uniform_int_distribution<>(from, to)(random_);
  }

 private:
  std::mt19937 random_;
};

Cutter random_cutter(Draw& draw, Feature feature) {
  const auto has = [&](Feature f) { return feature == f || feature == Feature::all; };
  Cutter c;
  const int modes = draw.whole(1, 3), teeth = draw.whole(2, 4);
  for (int i = 0; i < modes; ++i)
    c.system.modes.push_back({.axis = i % 2 ? Axis::y : Axis::x,
                              .wn_rad_s = 2 * kPi * draw.within(400, 2000),
                              .zeta = draw.within(0.01, 0.05),
                              .k_N_mm = draw.within(4000, 30000)});
  c.system.teeth = teeth;
  const double immersion = draw.within(0.05, 1);
  const Engagement cut =
      draw.whole(0, 1) ? up_milling(immersion) : down_milling(immersion);
  c.system.entry_rad = cut.entry_rad;
  c.system.exit_rad = cut.exit_rad;
  c.system.force =
      LinearForce{.Kt_MPa = draw.within(600, 2500), .Kn_MPa = draw.within(200, 900)};
  c.diameter_mm = draw.within(6, 20);
  if (has(Feature::helix)) c.helix_rad = draw.within(10, 50) * kPi / 180;
  if (has(Feature::pitches)) {
    double sum = 0;
    for (int j = 0; j < teeth; ++j) {
      c.pitch_rad.push_back(draw.within(0.8, 1.2));
      sum += c.pitch_rad.back();
    }
    for (double& pitch : c.pitch_rad) pitch *= 2 * kPi / sum;
  }
  if (has(Feature::runout)) {
    for (int j = 0; j < teeth; ++j)
      c.offset_mm.push_back(j == 0 ? 0 : draw.within(-0.01, 0.01));
    c.feed_mm = draw.within(0.03, 0.15);
  }
  if (has(Feature::damping)) {
    c.indentation_N_mm = draw.within(10, 300);
    c.friction = draw.within(0, 0.3);
  }
  return c;
}

/// Calls for every cutter and speed, with the limits told.
template <class F>
void for_each_told(double work, F visit) {
  for (const Feature feature : kFeatures)
    for (int i = 0; i < cutters_a_feature(); ++i) {
      Draw draw(1000 * static_cast<unsigned>(feature) + static_cast<unsigned>(i));
      const Cutter cutter = random_cutter(draw, feature);
      const double ap_max = draw.within(0.5, 4);
      for (int speed = 0; speed < 4; ++speed) {
        const double n_rpm = draw.within(5000, 20000);
        SCOPED_TRACE(testing::Message() << "feature " << static_cast<int>(feature)
                                        << ", cutter " << i << " at " << n_rpm);
        try {
          visit(cutter, n_rpm, speed_limits(cutter, n_rpm, ap_max, {}, work));
        } catch (const ModelRangeError&) {
        }
      }
    }
}

/// ln |mu| of the multiplier at a crossing.
double outside(const Cutter& c, double n_rpm, double w_mm, const Crossing& at,
               const Fineness& fineness) {
  return std::log(std::abs(
      DelayMap(c, n_rpm, w_mm, fineness).multiplier_near(std::polar(1.0, at.theta_rad))));
}

// Against a period cut into pieces an eighth as long.
TEST(RandomCutters, ErrorEstimatesCoverTheErrors) {
  constexpr Fineness kOver{1.5, 1e-17};
  constexpr double kBy = 1e-4;
  int looked_at = 0;
  for_each_told(5e9, [&](const Cutter& c, double n, const SpeedLimits& told) {
    for (const Crossing& at : told.crossings) {
      const double slope = (outside(c, n, (1 + kBy) * at.ap_mm, at, kPlain) -
                            outside(c, n, (1 - kBy) * at.ap_mm, at, kPlain)) /
                           (2 * kBy);
      EXPECT_LE(std::abs(outside(c, n, at.ap_mm, at, kOver) / slope), at.relative_error);
      EXPECT_LE(at.relative_error, 1e-8);
      ++looked_at;
    }
  });
  EXPECT_GE(looked_at, 6);
}

// The edge in slices, that look for themselves what they cut: 3 % below and above.
TEST(RandomCutters, LimitsAreWhereTheSimulationHasThem) {
  int looked_at = 0;
  for_each_told(5e9, [&](const Cutter& c, double n, const SpeedLimits& told) {
    if (!told.limit_mm()) return;
    for (const double share : {0.97, 1.03}) {
      SliceSimulation simulated(c, n, share * *told.limit_mm(), 500,
                                c.helix_rad > 0 ? 30 : 1);
      simulated.run(60, false);
      EXPECT_EQ(simulated.growth() > 1, share > 1) << share;
      ++looked_at;
    }
  });
  EXPECT_GE(looked_at, 8);
}

/// Unlike teeth with a long edge.
Cutter stubborn() {
  Cutter c;
  c.system = {
      .modes = {{.axis = Axis::x, .wn_rad_s = 5000, .zeta = 0.02, .k_N_mm = 3000},
                {.axis = Axis::y, .wn_rad_s = 6000, .zeta = 0.02, .k_N_mm = 3000}},
      .teeth = 3,
      .entry_rad = 0,
      .exit_rad = 2,
      .force = LinearForce{.Kt_MPa = 1500, .Kn_MPa = 600}};
  c.diameter_mm = 12;
  c.helix_rad = 0.6;
  c.pitch_rad = {2.0, 2.1, 2 * kPi - 4.1};
  c.offset_mm = {0, 0.004, -0.003};
  c.feed_mm = 0.06;
  c.indentation_N_mm = 10;
  return c;
}
constexpr double kDeep = 60;  // mm

// What is found below the depth at which the work ends is told, with that depth.
TEST(RandomCutters, SearchesThatEndEarlyTellWhatTheyFound) {
  const Cutter c = stubborn();
  const SpeedLimits whole = speed_limits(c, 12000, 0.35);
  ASSERT_FALSE(whole.searched_mm);
  ASSERT_TRUE(whole.limit_mm());
  const std::vector<double> depths{*whole.limit_mm() / 2, *whole.limit_mm() * 1.01,
                                   kDeep};
  const SpeedLimits part = speed_limits(c, 12000, kDeep, depths, 1e10);
  ASSERT_TRUE(part.searched_mm);
  EXPECT_LT(*part.searched_mm, kDeep);
  ASSERT_GT(*part.searched_mm, depths[1]);
  EXPECT_NEAR(*part.limit_mm() / *whole.limit_mm(), 1, 1e-8);
  ASSERT_EQ(part.unstable.size(), 2u);
  EXPECT_EQ(part.unstable[0], 0);
  EXPECT_GT(part.unstable[1], 0);
}

// A hard speed neither refuses the sweep nor those slower than itself.
TEST(RandomCutters, SweepsAreToldSpeedBySpeed) {
  ChartRequest q;
  q.cutter = stubborn();
  q.system = q.cutter->system;
  q.ap_max_mm = kDeep;
  q.work = 1e10;
  q.speeds_rpm = {12000, 10, 8};
  const StabilityChart chart = stability_chart(q);
  ASSERT_EQ(chart.speeds.size(), 1u);
  EXPECT_TRUE(chart.speeds[0].limits.limit_mm());
  EXPECT_TRUE(chart.speeds[0].limits.searched_mm);
  EXPECT_TRUE(chart.best);
  ASSERT_EQ(chart.undecided_speeds.size(), 2u);
  for (const std::size_t i : {0u, 1u}) {
    EXPECT_EQ(chart.undecided_speeds[i].index, i + 1);
    EXPECT_FALSE(chart.undecided_speeds[i].stable_to_mm);
    EXPECT_EQ(chart.undecided_speeds[i].harder_rpm, 0);  // it was tried
  }
}

// A speed that loses no stability as far as it was searched is not called stable.
TEST(RandomCutters, StableAsFarAsSearchedIsUndecidedAbove) {
  ChartRequest q;
  q.cutter = stubborn();
  q.system = q.cutter->system;
  q.ap_max_mm = 1;
  q.work = 3.6e9;
  q.speeds_rpm = {12000};
  const StabilityChart chart = stability_chart(q);
  EXPECT_TRUE(chart.speeds.empty());
  EXPECT_FALSE(chart.best);
  ASSERT_EQ(chart.undecided_speeds.size(), 1u);
  const auto& stable_to = chart.undecided_speeds[0].stable_to_mm;
  ASSERT_TRUE(stable_to);
  EXPECT_EQ(multipliers(*q.cutter, 12000, *stable_to).unstable, 0);
}

}  // namespace
}  // namespace turnwright::chatter
