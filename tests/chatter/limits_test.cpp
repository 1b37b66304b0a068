#include "turnwright/chatter/limits.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <random>
#include <vector>

#include "chatter/fundamental_matrix/stability_crossings.hpp"
#include "cutters.hpp"

namespace turnwright::chatter {
namespace {

using units::kPi;

/// Half a unit of the fourth digit.
double printed(double value) {
  return 0.5 * std::pow(10, std::floor(std::log10(value)) - 3);
}

struct Row {
  Directions directions;
  double immersion, n_rpm, limit_mm;
  bool flip;
};

// First loss of stability of the benchmark, computed elsewhere by two high-order methods
// that agree to 1e-9.
constexpr Row kBenchmark[] = {{Directions::one, 1, 5000, .4086, false},
                              {Directions::one, .1, 5000, 1.296, false},
                              {Directions::one, .05, 5000, 2.207, false},
                              {Directions::two, 1, 5000, .04751, false},
                              {Directions::two, .1, 5000, .9164, false},
                              {Directions::two, .05, 5000, 1.844, false},
                              {Directions::one, 1, 10000, .3224, false},
                              {Directions::one, .1, 10000, 2.518, true},
                              {Directions::one, .05, 10000, 4.091, true},
                              {Directions::two, 1, 10000, .07141, false},
                              {Directions::two, .1, 10000, .9701, false},
                              {Directions::two, .05, 10000, 1.487, false},
                              {Directions::one, 1, 20000, 1.418, true},
                              {Directions::one, .1, 20000, 1.221, false},
                              {Directions::one, .05, 20000, 2.299, false},
                              {Directions::two, 1, 20000, .06322, false},
                              {Directions::two, .1, 20000, 2.836, false},
                              {Directions::two, .05, 20000, 3.250, true}};

TEST(Limits, OfTheBenchmarkToTheirPrintedDigits) {
  for (const Row& row : kBenchmark) {
    const System s = benchmark(row.directions, down_milling(row.immersion));
    const SpeedLimits at = speed_limits(s, row.n_rpm, 1.2 * row.limit_mm);
    ASSERT_FALSE(at.crossings.empty());
    const Crossing& first = at.crossings.front();
    EXPECT_NEAR(first.ap_mm, row.limit_mm, printed(row.limit_mm)) << row.n_rpm;
    EXPECT_EQ(first.flip, row.flip) << row.n_rpm << " " << row.immersion;
    EXPECT_LT(first.relative_error, 1e-8);
  }
}

TEST(Limits, OfTheSlotCutterToTheirPrintedDigits) {
  const struct {
    double n_rpm, limit_mm;
    bool flip;
  } rows[] = {{5000, 5.453, false},
              {10000, 5.102, false},
              {15000, 26.47, true},
              {18000, 55.98, true}};
  for (const auto& row : rows) {
    const SpeedLimits at = speed_limits(slot_cutter(), row.n_rpm, 60);
    EXPECT_NEAR(at.crossings.at(0).ap_mm, row.limit_mm, printed(row.limit_mm));
    EXPECT_EQ(at.crossings[0].flip, row.flip);
    EXPECT_LT(at.crossings[0].relative_error, 1e-8);
  }
}

// Limits by Taylor series of the motion in arithmetic of 64 binary digits.
TEST(Limits, ErrorEstimatesCoverTheRoundingOfManyModes) {
  const Engagement cut = up_milling(0.793);
  System s{.modes = {{Axis::x, 395.2, 0.052, 7138},
                     {Axis::y, 738.9, 0.019, 17759},
                     {Axis::x, 1609, 0.0122, 14709},
                     {Axis::y, 2135.9, 0.0416, 27327},
                     {Axis::x, 1552.3, 0.0145, 5840},
                     {Axis::x, 550.6, 0.0231, 26518}},
           .teeth = 4,
           .entry_rad = cut.entry_rad,
           .exit_rad = cut.exit_rad,
           .force = LinearForce{.Kt_MPa = 632, .Kn_MPa = 563}};
  for (Mode& m : s.modes) m.wn_rad_s *= 2 * kPi;
  const struct {
    double n_rpm, limit_mm;
  } rows[] = {{13400, 0.3438818907587579922}, {13500, 0.3260346422301650315},
              {14200, 0.2720552498758869890}, {14300, 0.2709580725990001537},
              {14400, 0.2711036361084671015}, {14500, 0.2724509786294689276}};
  for (const auto& row : rows) {
    const Crossing first = speed_limits(s, row.n_rpm, 3).crossings.at(0);
    EXPECT_LE(std::abs(first.ap_mm / row.limit_mm - 1), first.relative_error)
        << row.n_rpm;
  }
}

TEST(Limits, IslandShowsAllItsCrossings) {
  const System s = benchmark(Directions::one, down_milling(0.1));
  const auto crossings = speed_limits(s, 18000, 8).crossings;
  ASSERT_EQ(crossings.size(), 3u);
  EXPECT_NEAR(crossings[0].ap_mm, 0.8157, 0.00005);
  EXPECT_NEAR(crossings[1].ap_mm, 3.118, 0.0005);
  EXPECT_NEAR(crossings[2].ap_mm, 3.831, 0.0005);
  EXPECT_TRUE(crossings[0].loss && !crossings[1].loss && crossings[2].loss);
  EXPECT_TRUE(crossings[0].flip && crossings[1].flip && !crossings[2].flip);
  EXPECT_EQ(multipliers(s, 18000, 0.8).unstable, 0);
  EXPECT_EQ(multipliers(s, 18000, 2).unstable, 1);
  EXPECT_EQ(multipliers(s, 18000, 3.5).unstable, 0);
  EXPECT_EQ(multipliers(s, 18000, 3.9).unstable, 2);
}

TEST(Limits, DeepSlotHasSixUnstableMultipliers) {
  const System s = benchmark(Directions::two, down_milling(1));
  EXPECT_EQ(multipliers(s, 9000, 5).unstable, 6);
}

// So deep that a zero is followed instead of every crossing found.
TEST(Limits, CountsReachBeyondTheSeries) {
  const System s = benchmark(Directions::two, down_milling(1));
  const std::vector<double> depths{0.02, 0.5, 2, 3.5, 5};
  const SpeedLimits at = speed_limits(s, 9000, 5, depths);
  EXPECT_EQ(at.unstable.front(), 0);
  EXPECT_EQ(at.unstable.back(), 6);
  for (std::size_t i = 0; i < depths.size(); ++i)
    EXPECT_EQ(at.unstable[i], multipliers(s, 9000, depths[i]).unstable) << depths[i];
}

// Up- and down-milling with an isotropic tool mirror each other.
TEST(Limits, IsotropicToolDoesNotKnowUpFromDown) {
  for (const double immersion : {0.07, 0.3, 0.6})
    for (const double n_rpm : {6100.0, 13000.0}) {
      const auto up =
          speed_limits(benchmark(Directions::two, up_milling(immersion)), n_rpm, 1);
      const auto down =
          speed_limits(benchmark(Directions::two, down_milling(immersion)), n_rpm, 1);
      ASSERT_EQ(up.crossings.size(), down.crossings.size());
      for (std::size_t i = 0; i < up.crossings.size(); ++i)
        EXPECT_NEAR(up.crossings[i].ap_mm / down.crossings[i].ap_mm, 1, 1e-9);
    }
}

// Lengths of time x c and stiffnesses x s: limits x s at speeds / c.
TEST(Limits, ScaleWithTimeAndStiffness) {
  const System s = benchmark(Directions::two, down_milling(0.2));
  System other = s;
  for (Mode& m : other.modes) {
    m.wn_rad_s *= 3;
    m.k_N_mm *= 7;
  }
  const double a = speed_limits(s, 7000, 2).limit_mm().value();
  const double b = speed_limits(other, 21000, 14).limit_mm().value();
  EXPECT_NEAR(b / a, 7, 1e-9);
}

// The samples of f and the product of its polynomials have nothing in common but the
// intervals.
TEST(Limits, SeriesFromSamplesIsThatOfThePolynomials) {
  for (const auto directions : {Directions::one, Directions::two})
    for (const double n_rpm : {6000.0, 15000.0}) {
      const System s = benchmark(directions, down_milling(0.2));
      const Characteristic f(s, n_rpm, kFine);
      constexpr double kDeepest = 3, kNoise = 1e-7;
      const auto exact =
          series(propagator(s, f.arcs(), n_rpm, kDeepest, kFine), kDeepest);
      const auto sampled = sampled_series(f, kDeepest, kNoise);
      ASSERT_TRUE(exact && sampled);
      EXPECT_GT(sampled->noise(0), 0);
      EXPECT_LT(sampled->noise(kDeepest), kNoise);
      for (int i = 0; i < 50; ++i) {
        const auto z = std::polar(i % 5 / 4.0, 0.7 * i),
                   kappa = std::polar(kDeepest * (i % 7) / 6, 1.1 * i);
        EXPECT_LE(std::abs(value(*exact, z, kappa).f - value(*sampled, z, kappa).f),
                  sampled->noise(kDeepest) + exact->noise(kDeepest));
      }
    }
}

TEST(Limits, SeriesFromSamplesEndsWhereRoundingDrownsIt) {
  const System s = many_modes(3, down_milling(1));
  const Characteristic f(s, 8000, kFine);
  EXPECT_TRUE(sampled_series(f, 0.5, 1e-7));
  EXPECT_FALSE(sampled_series(f, 0.5, 1e-13));
  EXPECT_FALSE(sampled_series(f, 50, 1e-7));
}

/// A turning tool: one mode under a constant factor.
System turning(double zeta, double K_MPa) {
  return {.modes = {{.axis = Axis::x, .wn_rad_s = 600, .zeta = zeta, .k_N_mm = 5000}},
          .teeth = 1,
          .entry_rad = 0,
          .exit_rad = kPi,
          .force = ConstantForce{K_MPa}};
}

// The lobes in closed form: 1 + w K G(i om)(1 - e^(-i om tau)) = 0 where w = -1/(2 K Re
// G).
struct Lobe {
  double w = 0, n_rpm = 0;
};
Lobe lobe(const System& s, double K, double r, int k) {
  const Mode& m = s.modes[0];
  const std::complex<double> G =
      1.0 / (m.k_N_mm * std::complex<double>(1 - r * r, 2 * m.zeta * r));
  const double w = -1 / (2 * K * G.real());
  double angle = -std::arg(1.0 + 1.0 / (w * K * G));
  if (angle < 0) angle += 2 * kPi;
  return {w, 60 * r * m.wn_rad_s / (angle + 2 * kPi * k)};
}

TEST(Limits, TurningKeepsTheAbsoluteLimitAtItsWorstSpeeds) {
  for (const double zeta : {0.01, 0.03, 0.2}) {
    const System s = turning(zeta, 800);
    const double least = 2 * 5000 * zeta * (1 + zeta) / 800;
    for (const int k : {0, 1, 2, 5, 9}) {
      const Lobe at = lobe(s, 800, std::sqrt(1 + 2 * zeta), k);
      EXPECT_NEAR(at.w / least, 1, 1e-12);
      const auto found = speed_limits(s, at.n_rpm, 1.05 * least);
      ASSERT_FALSE(found.crossings.empty()) << zeta << " " << k;
      EXPECT_NEAR(found.crossings[0].ap_mm / least, 1, 1e-8);
      // The frequency that the period folds on it and that is nearer the natural one.
      const double true_Hz = 600 * std::sqrt(1 + 2 * zeta) / (2 * kPi);
      const double told_Hz = found.crossings[0].frequency_Hz, tau = 60 / at.n_rpm;
      EXPECT_NEAR(std::min(std::abs(std::remainder((told_Hz - true_Hz) * tau, 1)),
                           std::abs(std::remainder((told_Hz + true_Hz) * tau, 1))),
                  0, 1e-6);
      EXPECT_LE(std::abs(told_Hz - 600 / (2 * kPi)),
                std::abs(true_Hz - 600 / (2 * kPi)) + 1e-9);
    }
  }
}

TEST(Limits, TurningFollowsItsLobes) {
  const System s = turning(0.03, 800);
  for (const double r : {1.02, 1.05, 1.1, 1.2})
    for (const int k : {0, 1, 3}) {
      const Lobe at = lobe(s, 800, r, k);
      // Other lobes may lie below this point of the lobe; then that one is the limit.
      double lowest = at.w;
      for (int other = 0; other < 12; ++other)
        for (double x = 1.0005; x < 3; x += 1e-3) {
          const Lobe a = lobe(s, 800, x, other), b = lobe(s, 800, x + 1e-3, other);
          if ((a.n_rpm - at.n_rpm) * (b.n_rpm - at.n_rpm) > 0) continue;
          const double t = (at.n_rpm - a.n_rpm) / (b.n_rpm - a.n_rpm);
          lowest = std::min(lowest, a.w + t * (b.w - a.w));
        }
      const double limit = speed_limits(s, at.n_rpm, 1.2 * at.w).limit_mm().value();
      EXPECT_NEAR(limit / lowest, 1, lowest == at.w ? 1e-8 : 1e-3) << r << " " << k;
    }
}

// No crossing is missed: between the crossings the count keeps to its side.
TEST(Limits, AgreeWithCountsAtRandomDepths) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(0, 1);
  for (int i = 0; i < 12; ++i) {
    const double immersion = 0.04 + 0.3 * share(random);
    const double n_rpm = 4000 + 20000 * share(random);
    const auto directions = i % 3 == 0 ? Directions::two : Directions::one;
    const System s = benchmark(directions, down_milling(immersion));
    const double deepest = 6;
    const auto crossings = speed_limits(s, n_rpm, deepest).crossings;
    for (int j = 0; j < 12; ++j) {
      const double w = deepest * share(random);
      const auto above = std::ranges::count_if(
          crossings, [&](const Crossing& c) { return c.ap_mm < w; });
      EXPECT_EQ(multipliers(s, n_rpm, w).unstable > 0, above % 2 == 1)
          << immersion << " " << n_rpm << " " << w;
    }
  }
}

// Winding numbers of the characteristic function itself, which the search for crossings
// does not use: none is missed, and none is one too many.
TEST(Limits, AgreeWithADenseGridOfCounts) {
  const bool all = std::getenv("TURNWRIGHT_LONG_TESTS") != nullptr;
  const int speeds = all ? 60 : 5, rows = all ? 200 : 60;
  std::mt19937 random(23);
  std::uniform_real_distribution<double> share(0, 1);
  const struct {
    System system;
    double deepest;
  } cases[] = {{benchmark(Directions::one, down_milling(0.1)), 6},
               {benchmark(Directions::one, down_milling(0.05)), 8},
               {benchmark(Directions::one, down_milling(1)), 2},
               {benchmark(Directions::two, down_milling(0.1)), 4},
               {benchmark(Directions::two, down_milling(1)), 0.3},
               {many_modes(3, down_milling(0.1)), 2},
               {many_modes(4, up_milling(0.4)), 0.6},
               {many_modes(6, down_milling(0.1)), 1},
               {slot_cutter(), 60}};
  for (const auto& c : cases)
    for (int i = 0; i < speeds; ++i) {
      const double n_rpm = 5000 + 20000 * share(random);
      std::vector<double> depths;
      for (int j = 1; j <= rows; ++j)
        depths.push_back(c.deepest * (j - share(random)) / rows);
      const SpeedLimits at = speed_limits(c.system, n_rpm, c.deepest, depths);
      const Characteristic f(c.system, n_rpm, kCoarse);
      for (std::size_t j = 0; j < depths.size(); ++j) {
        const int outside = multipliers_outside(f, depths[j]);
        EXPECT_EQ(at.unstable[j], outside) << n_rpm << " " << depths[j];
        const auto below = std::ranges::count_if(
            at.crossings, [&](const Crossing& x) { return x.ap_mm < depths[j]; });
        EXPECT_EQ(outside > 0, below % 2 == 1) << n_rpm << " " << depths[j];
      }
    }
}

// Where a multiplier is 1 the delayed displacement is the present one and nothing cuts:
// det(I - Phi) is that of the free vibration whatever the depth, and not 0.
TEST(Limits, NoMultiplierEverPassesThroughOne) {
  for (const auto directions : {Directions::one, Directions::two}) {
    const System s = benchmark(directions, down_milling(0.3));
    const Characteristic f(s, 9000, kFine);
    const double tau = period_s(s, 9000), wn = s.modes[0].wn_rad_s, zeta = 0.011;
    const std::complex<double> mu =
        std::exp(std::complex<double>(-zeta, std::sqrt(1 - zeta * zeta)) * wn * tau);
    const double free = std::pow(std::norm(1.0 - mu), s.modes.size());
    for (const double w : {0.0, 0.3, 2.0})
      EXPECT_NEAR(std::abs(f.value(1, w) - free), 0, 1e-12 * free) << w;
  }
}

TEST(Limits, SpectralRadiusIsOneWhereTheLimitIs) {
  const System s = benchmark(Directions::two, down_milling(0.1));
  const double limit = speed_limits(s, 5000, 2).limit_mm().value();
  EXPECT_NEAR(multipliers(s, 5000, limit * (1 - 1e-4)).spectral_radius, 1, 1e-3);
  EXPECT_LT(multipliers(s, 5000, limit * (1 - 1e-4)).spectral_radius, 1);
  EXPECT_GT(multipliers(s, 5000, limit * (1 + 1e-4)).spectral_radius, 1);
}

TEST(Limits, CutOfNoDepthVibratesFreely) {
  const System s = benchmark(Directions::one, down_milling(0.1));
  const Multipliers at = multipliers(s, 12000, 0);
  EXPECT_EQ(at.unstable, 0);
  EXPECT_NEAR(at.spectral_radius, std::exp(-0.011 * 922 * 2 * kPi * 60 / (2 * 12000.0)),
              1e-15);
  EXPECT_NEAR(multipliers(s, 12000, 1e-6).spectral_radius, at.spectral_radius, 1e-5);
}

}  // namespace
}  // namespace turnwright::chatter
