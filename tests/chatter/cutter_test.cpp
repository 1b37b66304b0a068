#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <random>

#include "constant_factor.hpp"
#include "cutters.hpp"
#include "slice_simulation.hpp"
#include "turnwright/chatter/cutter_limits.hpp"
#include "turnwright/chatter/limits.hpp"

namespace turnwright::chatter {
namespace {

using units::kPi;

/// A mill of 10 mm with modes of unlike axes.
Cutter mill(int teeth, const Engagement& cut) {
  Cutter c;
  c.system = {
      .modes = {{.axis = Axis::x, .wn_rad_s = 5000, .zeta = 0.02, .k_N_mm = 8000},
                {.axis = Axis::y, .wn_rad_s = 6200, .zeta = 0.03, .k_N_mm = 11000}},
      .teeth = teeth,
      .entry_rad = cut.entry_rad,
      .exit_rad = cut.exit_rad,
      .force = LinearForce{.Kt_MPa = 700, .Kn_MPa = 250}};
  c.diameter_mm = 10;
  return c;
}

Cutter with_pitches(Cutter c, std::vector<double> deg) {
  for (double& x : deg) x *= kPi / 180;
  c.pitch_rad = deg;
  return c;
}

void expect_same(const std::vector<Crossing>& a, const std::vector<Crossing>& b,
                 double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_NEAR(a[i].ap_mm / b[i].ap_mm, 1, tolerance);
    EXPECT_EQ(a[i].loss, b[i].loss);
  }
}

// No option: the method of limits.hpp, islands included, by tooth and by revolution.
TEST(Cutter, PlainIsThatOfTheSystem) {
  for (const auto directions : {Directions::one, Directions::two})
    for (const double immersion : {0.1, 1.0})
      for (const double n : {9000.0, 18000.0}) {
        const System s = benchmark(directions, down_milling(immersion));
        const double deepest = immersion < 1 ? 4.5 : 0.3;
        const auto right = speed_limits(s, n, deepest).crossings;
        Cutter plain;
        plain.system = s;
        const auto found = speed_limits(plain, n, deepest).crossings;
        expect_same(found, right, 1e-8);
        for (std::size_t i = 0; i < found.size(); ++i) {
          EXPECT_EQ(found[i].flip, right[i].flip);
          EXPECT_NEAR(found[i].frequency_Hz, right[i].frequency_Hz, 1e-4);
          EXPECT_LT(found[i].relative_error, 1e-8);
        }
        const auto turned = speed_limits(with_pitches(plain, {180, 180}), n, deepest);
        expect_same(turned.crossings, right, 1e-8);
      }
}

TEST(Cutter, HelixAndOffsetsFadeOut) {
  Cutter plain;
  plain.system = benchmark(Directions::two, down_milling(0.1));
  plain.diameter_mm = 10;
  const auto right = speed_limits(plain.system, 10000, 2).crossings;
  ASSERT_FALSE(right.empty());
  Cutter helical = plain;
  helical.helix_rad = 1e-7;
  expect_same(speed_limits(helical, 10000, 2).crossings, right, 1e-6);
  Cutter uneven = plain;
  uneven.offset_mm = {0, 1e-9};
  uneven.feed_mm = 0.1;
  expect_same(speed_limits(uneven, 10000, 2).crossings, right, 1e-6);
}

// A tooth far shorter than its neighbour never cuts.
TEST(Cutter, ToothThatNeverCutsIsNone) {
  Cutter two = mill(2, up_milling(0.3));
  two.offset_mm = {0, -5};
  two.feed_mm = 0.05;
  Cutter one = mill(1, up_milling(0.3));
  expect_same(speed_limits(two, 12000, 4).crossings,
              speed_limits(one.system, 12000, 4).crossings, 1e-8);
}

// Over a whole axial pitch the edges cut alike at every angle: a constant factor, whose
// multipliers the characteristic equation has.
TEST(Cutter, WholeAxialPitchCutsLikeTurning) {
  Cutter c = mill(4, down_milling(0.2));
  c.system.modes.resize(1);
  c.helix_rad = 0.6;
  const double pitch_mm = kPi * c.diameter_mm / (4 * std::tan(c.helix_rad));
  const auto& force = std::get<LinearForce>(c.system.force);
  double mean = 0;  // of h_xx over the angle
  constexpr int kParts = 20000;
  const double width = kPi - c.system.entry_rad;
  for (int i = 0; i < kParts; ++i) {
    const double phi = c.system.entry_rad + width * (i + 0.5) / kParts;
    mean += (force.Kt_MPa * std::cos(phi) + force.Kn_MPa * std::sin(phi)) *
            std::sin(phi) * width / kParts;
  }
  const double K = mean * 4 / (2 * kPi);
  const Mode& m = c.system.modes[0];
  for (const double n : {4000.0, 9000.0}) {
    const double tau = 60 / (4 * n), b = pitch_mm * K / m.k_N_mm;
    EXPECT_NEAR(multipliers(c, n, pitch_mm).spectral_radius /
                    radius_under_constant_factor(m, b, tau),
                1, 1e-6)
        << n;
  }
}

// In turning the flank's term is damping of the mode.
TEST(Cutter, IndentationInTurningIsDamping) {
  Cutter c;
  c.system = {.modes = {{.axis = Axis::x, .wn_rad_s = 900, .zeta = 0.03, .k_N_mm = 4000}},
              .teeth = 1,
              .entry_rad = 0,
              .exit_rad = 2 * kPi,
              .force = ConstantForce{250}};
  c.diameter_mm = 60;
  c.indentation_N_mm = 600;
  for (const double n : {700.0, 2500.0})
    for (const double w : {0.5, 2.0}) {
      const double speed = kPi * 60 * n / 60;
      System damped = c.system;
      Mode& m = damped.modes[0];
      m.zeta += w * c.indentation_N_mm / speed * m.wn_rad_s / (2 * m.k_N_mm);
      const Multipliers a = multipliers(c, n, w), b = multipliers(damped, n, w);
      EXPECT_NEAR(a.spectral_radius / b.spectral_radius, 1, 1e-8) << n << " " << w;
      EXPECT_EQ(a.unstable, b.unstable);
    }
}

TEST(Cutter, RevolutionsAreTeethInARow) {
  const Cutter c = mill(3, up_milling(0.5));
  const double tooth = multipliers(c, 7000, 1).spectral_radius;
  const double turn =
      multipliers(with_pitches(c, {120, 120, 120}), 7000, 1).spectral_radius;
  EXPECT_NEAR(turn, tooth * tooth * tooth, 1e-9);
}

// Which tooth is called the first does not matter, nor do the units of time and length.
struct Option {
  const char* name;
  Cutter cutter;
  double n_rpm, ap_mm;
};

std::vector<Option> options() {
  Cutter helical = mill(2, down_milling(0.1));
  helical.helix_rad = 0.5;
  const Cutter pitched = with_pitches(mill(4, down_milling(0.5)), {84, 96, 85, 95});
  Cutter uneven = mill(3, up_milling(0.4));
  uneven.offset_mm = {0, 0.03, -0.05};
  uneven.feed_mm = 0.06;
  Cutter damped = mill(2, {0, kPi});
  damped.indentation_N_mm = 300;
  damped.friction = 0.3;
  Cutter all = with_pitches(helical, {170, 190});
  all.offset_mm = {0, 0.02};
  all.feed_mm = 0.05;
  all.indentation_N_mm = 100;
  all.friction = 0.2;
  return {{"helix", helical, 11000, 4},       {"deep helix", helical, 21000, 25},
          {"pitches", pitched, 5000, 0.6},    {"offsets", uneven, 8000, 1.5},
          {"indentation", damped, 6000, 0.4}, {"all", all, 9500, 3}};
}

/// The same of the benchmark tool near its limits.
std::vector<Option> at_limits() {
  Cutter tool;
  tool.system = benchmark(Directions::one, down_milling(0.1));
  tool.diameter_mm = 10;
  Cutter helical = tool, uneven = tool, damped = tool;
  helical.helix_rad = 0.5;
  uneven.offset_mm = {0, 0.01};
  uneven.feed_mm = 0.05;
  damped.indentation_N_mm = 30;
  Cutter all = with_pitches(helical, {172, 188});
  all.offset_mm = {0, 0.003};
  all.feed_mm = 0.05;
  all.indentation_N_mm = 10;
  all.friction = 0.3;
  return {{"helix", helical, 18000, 4},
          {"pitches", with_pitches(tool, {172, 188}), 18000, 4},
          {"offsets", uneven, 18000, 4},
          {"indentation", damped, 18000, 4},
          {"all", all, 18000, 4}};
}

TEST(Cutter, InvariantUnderNamesAndScales) {
  Cutter c = with_pitches(at_limits().back().cutter, {165, 195});
  c.offset_mm = {0, 0.01};
  const auto right = speed_limits(c, 18000, 4).crossings;
  ASSERT_FALSE(right.empty());
  Cutter named = with_pitches(c, {195, 165});
  named.offset_mm = {0.01, 0};
  expect_same(speed_limits(named, 18000, 4).crossings, right, 1e-6);
  Cutter faster = c;
  for (Mode& m : faster.system.modes) m.wn_rad_s *= 1.7;
  expect_same(speed_limits(faster, 18000 * 1.7, 4).crossings, right, 1e-6);
  Cutter harder = c;
  for (Mode& m : harder.system.modes) m.k_N_mm *= 2.5;
  harder.indentation_N_mm *= 2.5;
  harder.system.force = LinearForce{.Kt_MPa = 2.5 * 600, .Kn_MPa = 2.5 * 200};
  expect_same(speed_limits(harder, 18000, 4).crossings, right, 1e-6);
}

TEST(Cutter, GrowsAsTheSimulationDoes) {
  for (const Option& o : options()) {
    SliceSimulation simulated(o.cutter, o.n_rpm, o.ap_mm, 1500,
                              o.cutter.helix_rad > 0 ? 80 : 1);
    simulated.run(60, false);
    const double tooth = multipliers(o.cutter, o.n_rpm, o.ap_mm).spectral_radius;
    const double turn =
        o.cutter.by_revolution() ? tooth : std::pow(tooth, o.cutter.system.teeth);
    EXPECT_NEAR(simulated.growth() / turn, 1, 4e-3) << o.name << " " << turn;
  }
}

// Five of a hundred above and below each crossing.
TEST(Cutter, CrossingsAreWhereTheSimulationHasThem) {
  int looked_at = 0;
  for (const Option& o : at_limits()) {
    const auto crossings = speed_limits(o.cutter, o.n_rpm, o.ap_mm).crossings;
    for (const Crossing& at : crossings)
      for (const double share : {0.95, 1.05}) {
        ++looked_at;
        SliceSimulation simulated(o.cutter, o.n_rpm, share * at.ap_mm, 600,
                                  o.cutter.helix_rad > 0 ? 40 : 1);
        simulated.run(60, false);
        EXPECT_EQ(simulated.growth() > 1, (share > 1) == at.loss)
            << o.name << " " << at.ap_mm << " " << share;
        EXPECT_EQ(multipliers(o.cutter, o.n_rpm, share * at.ap_mm).unstable > 0,
                  (share > 1) == at.loss);
      }
  }
  EXPECT_GE(looked_at, 8);
}

// Counts at depths are those of single cuts, also where teeth of unlike pitch flip.
TEST(Cutter, CountsAtDepthsAreThoseOfCuts) {
  for (const Option& o : at_limits()) {
    std::vector<double> depths;
    for (int i = 1; i <= 4; ++i) depths.push_back(o.ap_mm * i / 4);
    const SpeedLimits speed = speed_limits(o.cutter, o.n_rpm, depths.back(), depths);
    for (std::size_t i = 0; i < depths.size(); ++i) {
      const Multipliers at = multipliers(o.cutter, o.n_rpm, depths[i]);
      EXPECT_EQ(speed.unstable[i], at.unstable) << o.name << " " << depths[i];
      EXPECT_TRUE(at.certified);
    }
  }
}

// Four teeth in a slot deep above the limit, where noise first hides zeros.
// Many vibrations of a tooth period, ends of contact that meet at depths searched.
TEST(Cutter, HelicesAtLowSpeedAreToldToTheEighthDigit) {
  Cutter c = mill(4, down_milling(0.1));
  c.system.modes.pop_back();
  c.system.force = LinearForce{.Kt_MPa = 2500, .Kn_MPa = 900};
  int found = 0;
  for (const double helix_deg : {15, 30, 45})
    for (const double n : {3000, 5000}) {
      SCOPED_TRACE(testing::Message() << helix_deg << " deg at " << n);
      c.helix_rad = helix_deg * kPi / 180;
      for (const Crossing& at : speed_limits(c, n, 6).crossings) {
        ++found;
        EXPECT_LE(at.relative_error, 1e-8);
        for (const double by : {-1e-7, 1e-7})
          EXPECT_EQ(multipliers(c, n, (1 + by) * at.ap_mm).unstable > 0,
                    (by > 0) == at.loss);
      }
    }
  EXPECT_GE(found, 5);
}

TEST(Cutter, DeepHelicalSlotIsTold) {
  Cutter c = with_pitches(mill(4, {0, kPi}), {84, 96, 85, 95});
  c.helix_rad = kPi / 6;
  const auto crossings = speed_limits(c, 12000, 4).crossings;
  ASSERT_FALSE(crossings.empty());
  for (const Crossing& at : crossings)
    for (const double share : {0.999, 1.001})
      EXPECT_EQ(multipliers(c, 12000, share * at.ap_mm).unstable > 0,
                (share > 1) == at.loss);
}

// Limits by the series in 1 - z of each depth, against the multipliers of the collocated
// motion.
TEST(Cutter, HelicesAloneAgreeWithCollocation) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0, 1);
  int lost = 0;
  for (int modes = 1; modes <= 5; ++modes)
    for (const double helix_deg : {12.0, 45.0}) {
      Cutter c{.system = many_modes(modes, down_milling(0.1 + 0.18 * modes))};
      c.system.teeth = 2 + modes % 3;
      if (modes == 2) {  // neither end of the cut at the beginning of a period
        c.system.entry_rad = 0.4;
        c.system.exit_rad = 1.1;
      }
      c.helix_rad = helix_deg * kPi / 180;
      c.diameter_mm = 12;
      const double n_rpm = 6000 + 12000 * share(random), deepest = 3.0 / modes;
      std::vector<double> depths;
      for (int i = 0; i < 6; ++i) depths.push_back(deepest * (i + share(random)) / 6);
      const SpeedLimits at = speed_limits(c, n_rpm, deepest, depths);
      ASSERT_FALSE(at.searched_mm) << modes << " " << helix_deg;
      for (std::size_t i = 0; i < depths.size(); ++i)
        EXPECT_EQ(at.unstable[i], multipliers(c, n_rpm, depths[i]).unstable)
            << modes << " " << helix_deg << " " << depths[i];
      for (const Crossing& x : at.crossings) {
        EXPECT_LT(x.relative_error, 1e-8);
        for (const double beside : {1 - 1e-6, 1 + 1e-6})
          EXPECT_EQ(multipliers(c, n_rpm, beside * x.ap_mm).unstable > 0,
                    (beside > 1) == x.loss);
        ++lost;
      }
    }
  EXPECT_GT(lost, 8);
}

TEST(Cutter, WallIsThatOfTheSimulation) {
  for (Option o : options()) {
    if (o.cutter.feed_mm == 0) o.cutter.feed_mm = 0.05;
    const double ap = 0.4 * o.ap_mm;
    if (multipliers(o.cutter, o.n_rpm, ap).unstable > 0) continue;
    SliceSimulation simulated(o.cutter, o.n_rpm, ap, 2000,
                              o.cutter.helix_rad > 0 ? 80 : 1);
    simulated.run(80, true);
    for (const Surface& wall : surfaces(o.cutter, o.n_rpm, ap)) {
      double largest = 0;
      for (const double left : wall.left_mm) largest = std::max(largest, std::abs(left));
      const std::size_t at = 10;  // half way up
      double right = 1e9, place = 0;
      for (std::size_t j = 0; j < static_cast<std::size_t>(o.cutter.system.teeth); ++j) {
        if (j > 0)
          place -= o.cutter.pitch_rad.empty() ? 2 * kPi / o.cutter.system.teeth
                                              : o.cutter.pitch_rad[j];
        const double lag =
            wall.height_mm[at] * 2 * std::tan(o.cutter.helix_rad) / o.cutter.diameter_mm;
        const double y =
            simulated.displacement((wall.up_milled ? 0 : kPi) - place + lag)(1);
        const double offset = o.cutter.offset_mm.empty() ? 0 : o.cutter.offset_mm[j];
        right = std::min(right, (wall.up_milled ? -y : y) - offset);
      }
      EXPECT_NEAR(wall.left_mm[at], right, 5e-3 * largest) << o.name;
    }
  }
}

}  // namespace
}  // namespace turnwright::chatter
