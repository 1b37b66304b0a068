#include <gtest/gtest.h>

#include "constant_factor.hpp"
#include "cutters.hpp"
#include "turnwright/chatter/limits.hpp"

namespace turnwright::chatter {
namespace {

System turning(double zeta) {
  return {.modes = {{.axis = Axis::x, .wn_rad_s = 600, .zeta = zeta, .k_N_mm = 5000}},
          .teeth = 1,
          .entry_rad = 0,
          .exit_rad = units::kPi,
          .force = ConstantForce{800}};
}

TEST(Multipliers, OfTurningAreThoseOfItsCharacteristicEquation) {
  for (const double zeta : {0.01, 0.3, 3.0})
    for (const double n_rpm : {60.0, 400.0, 3000.0})
      for (const double ap_mm : {0.02, 0.5, 3.0}) {
        const System s = turning(zeta);
        const double right =
            radius_under_constant_factor(s.modes[0], ap_mm * 800 / 5000, 60 / n_rpm);
        const Multipliers at = multipliers(s, n_rpm, ap_mm);
        EXPECT_NEAR(at.spectral_radius / right, 1, 1e-8)
            << zeta << " " << n_rpm << " " << ap_mm;
        EXPECT_EQ(at.unstable > 0, right > 1) << zeta << " " << n_rpm << " " << ap_mm;
      }
}

// A period of many vibrations of modes of unlike damping, whose free motion leaves
// nothing.
TEST(Multipliers, AreToldAtLowSpeed) {
  System s = benchmark(Directions::two, down_milling(0.3));
  s.modes[1].zeta = 4;
  for (const double n_rpm : {150.0, 600.0}) {
    const Multipliers little = multipliers(s, n_rpm, 0.01),
                      much = multipliers(s, n_rpm, 3);
    EXPECT_EQ(little.unstable, 0) << n_rpm;
    EXPECT_LT(little.spectral_radius, 1) << n_rpm;
    EXPECT_EQ(much.unstable > 0, much.spectral_radius > 1) << n_rpm;
  }
}

TEST(Multipliers, NothingThatCannotVibrateIsUnstable) {
  System rigid = turning(0.01);
  rigid.modes.clear();
  const Multipliers at = multipliers(rigid, 900, 1);
  EXPECT_EQ(at.unstable, 0);
  EXPECT_EQ(at.spectral_radius, 0);
}

}  // namespace
}  // namespace turnwright::chatter
