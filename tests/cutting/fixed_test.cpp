#include "turnwright/cutting/fixed.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "turnwright/base/units.hpp"

namespace turnwright::cutting {
namespace {

constexpr catalogue::Kienzle kSteel{1600, 0.25};

// h = 1 mm where f = 2 mm and the point is flat: kc is kc1.1.
TEST(Drill, IsKc11AtOneMillimetreOfChip) {
  const auto l = drill(kSteel, 20, 2, 180);
  EXPECT_NEAR(l.Fc_N, 1600 * 2 * 10, 1e-9 * l.Fc_N);
  EXPECT_NEAR(l.M_Nm, 1600 * 2 * 20 * 20 / 8.0 / 1000, 1e-9 * l.M_Nm);
  EXPECT_NEAR(l.Ff_N, 0.5 * 1600 * 2 * 10, 1e-9 * l.Ff_N);
}

// The torque integrated over both edges, each a chip f/2 deep of thickness h.
TEST(Drill, TorqueIsTheEdgesForceOverTheirRadius) {
  const double D = 16, f = 0.25, point = 140;
  const double h = f / 2 * std::sin(units::rad_from_deg(point / 2));
  double M = 0;
  constexpr int kSteps = 1000;
  for (int i = 0; i < kSteps; ++i) {
    const double r = D / 2 * (i + 0.5) / kSteps, dr = D / 2 / kSteps;
    M += 2 * 1600 * std::pow(h, -0.25) * f / 2 * dr * r / 1000;
  }
  EXPECT_NEAR(drill(kSteel, D, f, point).M_Nm, M, 1e-6 * M);
}

// Power at the spindle is specific force times what is removed.
TEST(Drill, PowerIsSpecificForceTimesVolumePerTime) {
  const double D = 12, f = 0.2, n = 2000;
  const auto l = drill(kSteel, D, f, 118);
  const double kc = 1600 * std::pow(f / 2 * std::sin(units::rad_from_deg(59)), -0.25);
  const double volume = units::kPi / 4 * D * D * f * n;  // mm3/min
  EXPECT_NEAR(units::shaft_power_kW(l.M_Nm, n), kc * volume / 60e6, 1e-9);
}

// As for a drill: the ring between the two diameters.
TEST(Ream, PowerIsSpecificForceTimesVolumePerTime) {
  const double D = 12, d = 11.8, f = 0.3, n = 250;
  const auto l = ream(kSteel, D, d, f, 6);
  const double kc = 1600 * std::pow(f / 6 * std::sqrt(0.5), -0.25);
  const double volume = units::kPi / 4 * (D * D - d * d) * f * n;  // mm3/min
  EXPECT_NEAR(units::shaft_power_kW(l.M_Nm, n), kc * volume / 60e6, 1e-12);
}

// The thrust of a countersink goes with the sine of half its angle.
TEST(Ream, OfAFlatterLeadPushesHarder) {
  const auto steep = ream({1600, 0}, 10, 8, 0.1, 3, 45),
             flat = ream({1600, 0}, 10, 8, 0.1, 3, 90);
  EXPECT_NEAR(flat.Ff_N / steep.Ff_N, std::sqrt(2), 1e-12);
  EXPECT_NEAR(flat.M_Nm, steep.M_Nm, 1e-12);
}

// By hand: each tooth of 2.5 pitches with three flutes takes 0.75/7.5 = 0.1 mm, so
// kc = 1600 0.1^-0.25 = 2845 N/mm2 and M = 2845 1.5^2 10/8 = 8.0 Nm.
TEST(Tap, TorqueOfM10InSteelIsEightNewtonMetres) {
  const auto l = tap(kSteel, 10, 1.5, 0.75, 2.5, 3);
  EXPECT_NEAR(l.M_Nm, 8.0, 0.05);
  EXPECT_NEAR(units::torque_Nm(l.Fc_N, 10), l.M_Nm, 1e-12);
  EXPECT_EQ(l.Ff_N, 0);
  EXPECT_NEAR(tap(kSteel, 20, 1.5, 0.75, 2.5, 3).M_Nm, 2 * l.M_Nm, 1e-9);
}

// The section of the thread by the profile's corners: 0.237 P^2 lies below P^2/4.
TEST(Tap, CutsALittleMoreThanTheSectionOfTheThread) {
  const double P = 2, H = std::sqrt(3) / 2 * P, depth = 5.0 / 8 * H;
  const double section = depth * (0.75 * P + 0.125 * P) / 2;
  EXPECT_NEAR(section, 0.237 * P * P, 1e-3);
  EXPECT_NEAR(tap({1, 0}, 16, P, depth, 2.5, 3).Fc_N, P * P / 4, 1e-12);
  EXPECT_GT(P * P / 4, section);
}

TEST(Pecks, AreAsLongAsTheyMayBeAndReachTheDepth) {
  const catalogue::Pecking pecking{3, 1};
  EXPECT_EQ(peck_depths_mm(std::nullopt, 10, 70), (std::vector<double>{70}));
  EXPECT_EQ(peck_depths_mm(pecking, 10, 30), (std::vector<double>{30}));
  EXPECT_EQ(peck_depths_mm(pecking, 10, 40), (std::vector<double>{30, 40}));
  EXPECT_EQ(peck_depths_mm(pecking, 10, 45), (std::vector<double>{30, 37.5, 45}));
}

TEST(Plunge, IsKienzleOfAStraightEdge) {
  const auto l = plunge(kSteel, {0.4, 60, 20}, 3, 1, 40);
  EXPECT_NEAR(l.Fc_N, 4800, 1e-9);
  EXPECT_NEAR(l.Ff_N, 0.4 * 4800 + 60 * 3, 1e-9);
  EXPECT_NEAR(l.M_Nm, 4800 * 0.02, 1e-9);
  EXPECT_NEAR(plunge(kSteel, {}, 3, 0.1, 40).Fc_N, 4800 * std::pow(0.1, 0.75), 1e-9);
}

TEST(ThreadInfeeds, HaveEqualChipsAndReachTheDepth) {
  const double h = 0.92;
  for (const int n : {1, 4, 6, 25}) {
    const auto all = thread_infeeds(kSteel, {0.4, 60, 20}, h, n, 30);
    ASSERT_EQ(all.size(), static_cast<std::size_t>(n));
    double depth = 0, area = std::tan(units::rad_from_deg(30)) * h * h / n;
    for (const auto& i : all) {
      const double next = depth + i.depth_mm;
      EXPECT_NEAR((next * next - depth * depth) * std::tan(units::rad_from_deg(30)), area,
                  1e-12);
      depth = next;
      const double L = 2 * depth / std::cos(units::rad_from_deg(30));
      EXPECT_NEAR(i.load.Fc_N, 1600 * L * std::pow(area / L, 0.75), 1e-9 * i.load.Fc_N);
      EXPECT_NEAR(i.load.Ff_N, 0.4 * i.load.Fc_N + 60 * L / 2, 1e-9 * i.load.Ff_N);
      EXPECT_NEAR(i.load.M_Nm, i.load.Fc_N * 0.015, 1e-9);
    }
    EXPECT_NEAR(depth, h, 1e-12);
  }
}

// A machine of constant torque to 1000 rpm, constant power above it.
TEST(AvailablePower, IsTheCurveTimesTheEfficiency) {
  catalogue::Lathe m;
  m.n_min_rpm = 10;
  m.n_max_rpm = 4000;
  m.efficiency = 0.8;
  const double M = 10 / units::shaft_power_kW(1, 1000);
  m.curve = {{100, 1, M}, {1000, 10, M}, {4000, 10, M / 4}};
  const auto ranges = speed_ranges(m);
  for (const bool torque : {true, false}) {
    EXPECT_NEAR(available_kW(ranges, 500, torque), 4, 1e-9);
    EXPECT_NEAR(available_kW(ranges, 2000, torque), 8, 1e-9);
  }
  EXPECT_NEAR(available_kW(ranges, 50, true), 0.4, 1e-9);
  EXPECT_LT(available_kW(ranges, 5000, true), 0);
}

}  // namespace
}  // namespace turnwright::cutting
