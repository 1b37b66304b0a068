#include <gtest/gtest.h>

#include <complex>
#include <random>

#include "turnwright/base/units.hpp"
#include "turnwright/chatter/cutter_limits.hpp"
#include "turnwright/chatter/limits.hpp"

namespace turnwright::chatter {
namespace {

using units::kPi;

Cutter turning(std::vector<Mode> modes, double C_N_mm) {
  Cutter c;
  c.system = {.modes = std::move(modes),
              .teeth = 1,
              .entry_rad = 0,
              .exit_rad = 2 * kPi,
              .force = ConstantForce{700}};
  c.diameter_mm = 50;
  c.indentation_N_mm = C_N_mm;
  return c;
}

Cutter random_turning(std::mt19937& random) {
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<Mode> modes;
  for (int i = 0; i < 1 + static_cast<int>(3 * share(random)); ++i)
    modes.push_back({.axis = Axis::x,
                     .wn_rad_s = 400 + 3000 * share(random),
                     .zeta = 0.01 + 0.05 * share(random),
                     .k_N_mm = 2000 + 20000 * share(random)});
  return turning(std::move(modes), share(random) < 0.3 ? 0 : 500 * share(random));
}

// The characteristic equation at a depth and a frequency told, written out anew.
double residual(const Cutter& c, double n_rpm, const Crossing& at) {
  const std::complex<double> s(0, 2 * kPi * at.frequency_Hz);
  std::complex<double> G = 0;
  for (const Mode& m : c.system.modes)
    G += m.wn_rad_s * m.wn_rad_s / m.k_N_mm /
         (s * s + 2 * m.zeta * m.wn_rad_s * s + m.wn_rad_s * m.wn_rad_s);
  const double v_mm_s = kPi * c.diameter_mm * n_rpm / 60;
  const auto force =
      700.0 * (1.0 - std::exp(-s * 60.0 / n_rpm)) + s * c.indentation_N_mm / v_mm_s;
  return std::abs(1.0 + at.ap_mm * G * force);
}

TEST(Turning, CrossingsSolveTheCharacteristicEquation) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> share(0, 1);
  int found = 0;
  for (int i = 0; i < 200; ++i) {
    const Cutter c = random_turning(random);
    const double n = 30 * std::pow(100, share(random));
    for (const Crossing& at : speed_limits(c, n, 10).crossings) {
      ++found;
      EXPECT_LE(residual(c, n, at), 1e-8) << i;
      EXPECT_LE(at.relative_error, 1e-8) << i;
    }
  }
  EXPECT_GE(found, 100);
}

// Collocation, which knows nothing of frequencies, counts as many.
TEST(Turning, CountsAgreeWithCollocation) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> share(0, 1);
  int unstable = 0;
  for (int i = 0; i < 40; ++i) {
    const Cutter c = random_turning(random);
    const double n = 2000 + 8000 * share(random);
    const std::vector<double> depths{0.05 + share(random), 1.5 + share(random)};
    const auto limits = speed_limits(c, n, 3, depths);
    for (std::size_t k = 0; k < depths.size(); ++k) {
      EXPECT_EQ(limits.unstable[k], multipliers(c, n, depths[k]).unstable) << i;
      unstable += limits.unstable[k] > 0;
    }
  }
  EXPECT_GE(unstable, 20);
  EXPECT_LE(unstable, 70);
}

// With lags of many waves the limit comes down to that of the worst speed.
TEST(Turning, AtSlowSpeedsTheLimitIsTheAbsoluteOne) {
  const Cutter c = turning({{Axis::x, 3000, 0.02, 5000}}, 0);
  const double absolute = 2 * 5000 * 0.02 * 1.02 / 700;
  const double limit = speed_limits(c, 5, 2 * absolute).limit_mm().value();
  EXPECT_GE(limit, absolute * (1 - 1e-12));
  EXPECT_LE(limit, absolute * (1 + 1e-4));
}

// Friction of the flank holds what the speed alone would not.
TEST(Turning, IndentationNeverLowersTheLimit) {
  std::mt19937 random(13);
  std::uniform_real_distribution<double> share(0, 1);
  for (int i = 0; i < 50; ++i) {
    Cutter c = random_turning(random);
    const double n = 60 * std::pow(30, share(random));
    double before = 0;
    for (const double C : {0.0, 50.0, 200.0, 1000.0}) {
      c.indentation_N_mm = C;
      const double limit = speed_limits(c, n, 20).limit_mm().value_or(20);
      EXPECT_GE(limit, before * (1 - 1e-9)) << i << " " << C;
      before = limit;
    }
  }
}

TEST(Turning, WorkThatOnlyMovesAlongTheCutNeverChatters) {
  const Cutter c = turning({{Axis::y, 3000, 0.02, 5000}}, 0);
  EXPECT_FALSE(speed_limits(c, 500, 20).limit_mm());
}

TEST(Turning, TooSlowToTell) {
  const Cutter c = turning({{Axis::x, 30000, 0.02, 5000}}, 0);
  EXPECT_THROW(speed_limits(c, 1e-4, 20), TooManyVibrations);
}

}  // namespace
}  // namespace turnwright::chatter
