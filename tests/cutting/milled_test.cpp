#include "turnwright/cutting/milled.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "turnwright/base/units.hpp"

namespace turnwright::cutting {
namespace {

// Mean over a tooth's way of a function of sin(phi), the ends where sin may be 0 graded.
template <class F>
double mean_over_way(double arc_rad, const F& of_sine) {
  constexpr int kSteps = 20000;
  const bool both = arc_rad > units::kPi - 1e-9;
  const double length = both ? arc_rad / 2 : arc_rad;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double u = (i + 0.5) / kSteps;
    sum += of_sine(std::sin(length * u * u * u * u)) * 4 * u * u * u / kSteps;
  }
  return sum;
}

TEST(MilledChip, OfAHalfAndAFullCutter) {
  const auto half = milled_chip(0.5), slot = milled_chip(1);
  EXPECT_NEAR(half.arc_rad, units::kPi / 2, 1e-15);
  EXPECT_NEAR(slot.arc_rad, units::kPi, 1e-15);
  EXPECT_EQ(half.hex_over_fz, 1);
  EXPECT_EQ(slot.hex_over_fz, 1);
  EXPECT_NEAR(slot.hm_over_fz, 2 / units::kPi, 1e-15);
}

TEST(MilledChip, IsTheSineOverTheWay) {
  for (const double a : {0.001, 0.03, 0.2, 0.49, 0.5, 0.7, 0.93, 1.0}) {
    const auto c = milled_chip(a);
    EXPECT_NEAR((1 - std::cos(c.arc_rad)) / 2, a, 1e-12);
    double most = 0;
    for (int i = 0; i <= 20000; ++i)
      most = std::max(most, std::sin(c.arc_rad * i / 20000));
    EXPECT_NEAR(c.hex_over_fz, most, 1e-8) << a;
    EXPECT_NEAR(c.hm_over_fz, mean_over_way(c.arc_rad, [](double s) { return s; }), 1e-6)
        << a;
  }
}

TEST(ChipStiffness, IsSaferThanTheMeanSlopeOfKienzlesLaw) {
  catalogue::Material m;
  for (const double mc : {0.05, 0.2, 0.25, 0.35, 0.6, 0.8})
    for (const double a : {0.001, 0.1, 0.5, 0.8, 1.0}) {
      const auto chip = milled_chip(a);
      const double fz = 0.06;
      const auto K = chip_stiffness({1500, mc}, m, fz * chip.hm_over_fz);
      const double slope = 1500 * (1 - mc) * mean_over_way(chip.arc_rad, [&](double s) {
                             return std::pow(fz * s, -mc);
                           });
      EXPECT_GT(K.Kt_MPa, slope) << mc << ' ' << a;
      if (mc == 0.25) {
        EXPECT_LT(K.Kt_MPa, 1.25 * slope);
      }
      EXPECT_EQ(K.Kn_MPa, catalogue::Thrust{}.ratio * K.Kt_MPa);
    }
}

TEST(ChipStiffness, TakesTheMaterialsOwnFeedForce) {
  catalogue::Material m;
  m.kf = catalogue::Kienzle{300, 0.7};
  const auto K = chip_stiffness({1500, 0.25}, m, 0.04);
  EXPECT_NEAR(K.Kn_MPa, 300 / std::pow(0.04, 0.7), 1e-9);
  EXPECT_NEAR(K.Kt_MPa, 1500 / std::pow(0.04, 0.25), 1e-9);
}

// At constant specific force (mc = 0) the teeth's torque over a turn is power.
TEST(MilledPower, IsTheTeethsWork) {
  const double a = 0.3, D = 12, fz = 0.05, ap = 3, n = 2500;
  const int z = 4;
  const auto chip = milled_chip(a);
  double work = 0;  // per tooth and turn, N mm
  constexpr int kSteps = 100000;
  for (int i = 0; i < kSteps; ++i) {
    const double phi = chip.arc_rad * (i + 0.5) / kSteps;
    work += 1800 * ap * fz * std::sin(phi) * D / 2 * chip.arc_rad / kSteps;
  }
  const double kW = work * z * n / 60 / 1e6;
  EXPECT_NEAR(milled_power_kW({1800, 0}, fz * chip.hm_over_fz, ap, a * D, fz * z * n), kW,
              1e-6 * kW);
  EXPECT_NEAR(milled_power_kW({1800, 0.25}, 0.04, ap, a * D, fz * z * n),
              kW * std::pow(0.04, -0.25), 1e-6 * kW);
}

TEST(TeethSum, OfOneToothAndOfManyInTheCut) {
  EXPECT_NEAR(teeth_sum(units::kPi, 1, 0.25), 1, 1e-12);  // at the top of the slot
  EXPECT_NEAR(teeth_sum(units::kPi / 2, 1, 0.25), 1, 1e-12);
  EXPECT_NEAR(teeth_sum(units::kPi / 6, 2, 0.25), std::pow(0.5, 0.75), 1e-12);
  // Four teeth in a slot at constant specific force: sin(phi) + cos(phi).
  EXPECT_NEAR(teeth_sum(units::kPi, 4, 0), std::sqrt(2.0), 1e-5);
  // Very many teeth: their number per angle times the integral of the sine.
  EXPECT_NEAR(teeth_sum(units::kPi, 720, 0), 720 / units::kPi, 1e-2);
  // Two teeth in a slot: one always cuts, two never count fully at once.
  EXPECT_NEAR(teeth_sum(units::kPi, 2, 0), 1, 1e-5);
}

}  // namespace
}  // namespace turnwright::cutting
