#include "turnwright/cutting/spindle.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace turnwright::cutting {
namespace {

constexpr double kPi = std::numbers::pi;

catalogue::Lathe lathe() {
  catalogue::Lathe m;
  m.n_min_rpm = 20;
  m.n_max_rpm = 4000;
  m.efficiency = 0.8;
  // 140 Nm up to 1000/min, constant power to 3000, falling above.
  const auto at = [](double n, double P) {
    return catalogue::CurvePoint{n, P, P * 30000 / (kPi * n)};
  };
  const double P = 140 * kPi * 1000 / 30000;
  m.curve = {at(200, P / 5), at(1000, P), at(3000, P), at(4000, 0.7 * P)};
  return m;
}

double available_kW(const SpeedRange& r, double n) {
  double P = 1e300;
  for (const auto& l : r.lines) P = std::min(P, l.c * std::pow(n, l.s));
  return P;
}

TEST(SpeedRanges, LeastLineIsTheCurve) {
  const auto ranges = speed_ranges(lathe());
  ASSERT_EQ(ranges.size(), 1u);
  const double P = 0.8 * 140 * kPi * 1000 / 30000;
  EXPECT_NEAR(available_kW(ranges[0], 50), P / 20, 1e-9);  // constant torque below
  EXPECT_NEAR(available_kW(ranges[0], 500), P / 2, 1e-9);
  EXPECT_NEAR(available_kW(ranges[0], 2000), P, 1e-9);
  EXPECT_NEAR(available_kW(ranges[0], 4000), 0.7 * P, 1e-9);
}

// A curve of constant torque printed with four digits: whether the last one is rounded up or
// down, the speed does not hang on it, and no more power is taken than is printed.
TEST(SpeedRanges, ATorqueRoundedInPrintIsConstant) {
  for (const double digits : {1 - 4e-4, 1 + 4e-4}) {
    auto m = lathe();
    m.curve[0].P_kW *= digits;
    const auto ranges = speed_ranges(m);
    ASSERT_EQ(ranges.size(), 1u);
    for (const auto& l : ranges[0].lines)
      if (l.s > 0.5) {
        EXPECT_TRUE(constant_torque(l)) << l.s;
      }
    for (const auto& point : {m.curve[0], m.curve[1]}) {
      const double P = available_kW(ranges[0], point.n_rpm);
      EXPECT_LE(P, 0.8 * point.P_kW * (1 + 1e-12));
      EXPECT_GE(P, 0.8 * point.P_kW * (1 - 1e-3));
    }
  }
}

TEST(SpeedRanges, ADipCutsTheRange) {
  auto m = lathe();
  m.curve[2].P_kW *= 0.5;  // gear change at 3000
  m.curve[2].M_Nm *= 0.5;
  const auto ranges = speed_ranges(m);
  ASSERT_EQ(ranges.size(), 2u);
  EXPECT_EQ(ranges[0].n_max_rpm, 3000);
  EXPECT_EQ(ranges[1].n_min_rpm, 3000);
  EXPECT_NEAR(available_kW(ranges[0], 2000),
              0.8 * std::exp(std::log(m.curve[1].P_kW) +
                             std::log(2.0) / std::log(3.0) *
                                 std::log(m.curve[2].P_kW / m.curve[1].P_kW)),
              1e-9);
}

// A motor of 11 kW, read off a picture in 30 points and noted to 0.1 kW and 1 Nm: the
// curve bends upwards at every third point, by rounding alone.
TEST(SpeedRanges, ACurveRoundedPointByPointIsOneRange) {
  auto m = lathe();
  m.curve.clear();
  for (int i = 0; i < 30; ++i) {
    const double n = std::round(100 * std::pow(40, i / 29.0));
    const double P = 11 * std::min({1.0, n / 700, std::pow(2500 / n, 0.6)});
    m.curve.push_back({n, std::round(10 * P) / 10, std::round(P * 30000 / (kPi * n))});
  }
  const auto ranges = speed_ranges(m);
  ASSERT_EQ(ranges.size(), 1u);
  for (std::size_t i = 0; i < m.curve.size(); ++i) {
    const auto& p = m.curve[i];
    const double printed = 0.8 * std::min(p.P_kW, p.M_Nm * p.n_rpm * kPi / 30000);
    EXPECT_LE(available_kW(ranges[0], p.n_rpm), printed * (1 + 1e-12)) << p.n_rpm;
    EXPECT_GE(available_kW(ranges[0], p.n_rpm), printed * 0.94) << p.n_rpm;
  }
}

// A dip of the plateau from 1000 to 3000 1/min, a little below and above what rounding makes.
TEST(SpeedRanges, ASmallDipLowersThePieceAndADeepOneCutsIt) {
  for (const double dip : {0.025, 0.035}) {
    auto m = lathe();
    auto low = m.curve[1];
    low.n_rpm = 2000;
    low.P_kW *= 1 - dip;
    low.M_Nm *= (1 - dip) / 2;
    m.curve.insert(m.curve.begin() + 2, low);
    const auto ranges = speed_ranges(m);
    ASSERT_EQ(ranges.size(), dip < 0.03 ? 1u : 2u);
    EXPECT_NEAR(available_kW(ranges[0], 2000), 0.8 * low.P_kW, 1e-9);
    EXPECT_NEAR(available_kW(ranges[0], 1000),
                0.8 * m.curve[1].P_kW * (dip < 0.03 ? 1 - dip : 1), 1e-9);
  }
}

TEST(SpeedRanges, PointsBeyondTheSpindleLimitNothing) {
  auto m = lathe();
  m.n_max_rpm = 2500;
  m.curve[3].P_kW *= 0.1;
  m.curve.push_back({6000, m.curve[2].P_kW, m.curve[2].M_Nm / 2});
  const auto ranges = speed_ranges(m);
  ASSERT_EQ(ranges.size(), 1u);
  EXPECT_EQ(ranges[0].n_max_rpm, 2500);
  for (const double n : {1500, 2500})
    EXPECT_NEAR(available_kW(ranges[0], n), 0.8 * m.curve[1].P_kW, 1e-9);
}

TEST(PowerSpeed, KeepsTheLineAtEveryDiameterOfASweep) {
  const auto lines = speed_ranges(lathe())[0].lines;
  for (const auto& sweep :
       {Sweep<double>{50, 40, 40, false, false}, Sweep<double>{30, 20, 60, true, false},
        Sweep<double>{40, 0, 80, true, true}})
    for (const auto& l : lines) {
      if (constant_torque(l)) continue;
      const double n_cap = 3500, Fc = 900;
      const double v = speed_at_power_m_min(l, Fc, sweep, n_cap);
      EXPECT_NEAR(power_share(l, Fc, sweep, v, n_cap), 1, 1e-9);
      double worst = 0;  // brute force over the sweep
      for (int i = 0; i <= 2000; ++i) {
        const double D =
            sweep.D_small_mm + (sweep.D_large_mm - sweep.D_small_mm) * i / 2000;
        const double n = D > 0 ? std::min(n_cap, 1000 * v / (kPi * D)) : n_cap;
        worst = std::max(worst, Fc * kPi * D * n / 6e7 / (l.c * std::pow(n, l.s)));
      }
      EXPECT_LE(worst, 1 + 1e-9);
      const bool capped_all = 1000 * v / (kPi * sweep.D_large_mm) > n_cap;
      if (!capped_all && l.s >= 0) {
        EXPECT_NEAR(worst, 1, 1e-9);
      }
    }
}

TEST(Duty, EqualsTheIntegralAlongThePath) {
  // Independent: the midpoint rule on dt = ds/(f n(D)), edges = dt/T(v_eff).
  const double n_T = 0.255, C = 450, f = 0.2;
  for (const auto& sweep :
       {Sweep<double>{30, 20, 60, true, false}, Sweep<double>{40, 0, 80, true, true},
        Sweep<double>{25, 49, 50, true, false}})
    for (const double v : {60.0, 250.0, 900.0})
      for (const double n_cap : {1200.0, 3500.0}) {
        const auto life = [&](double speed) { return std::pow(C / speed, 1 / n_T); };
        double time = 0, edges = 0;
        const int steps = 400000;
        for (int i = 0; i < steps; ++i) {
          const double D = sweep.D_small_mm +
                           (sweep.D_large_mm - sweep.D_small_mm) * (i + 0.5) / steps;
          const double n = std::min(n_cap, 1000 * v / (kPi * D));
          const double dt = sweep.path_mm / steps / (f * n);
          time += dt;
          edges += dt / life(kPi * D * n / 1000);
        }
        const auto d = duty(sweep, v, f, life(v), n_cap, n_T);
        EXPECT_NEAR(d.time_min / time, 1, 1e-9);
        EXPECT_NEAR(d.edges / edges, 1, 1e-9);
      }
}

TEST(Duty, ACylinderIsTheTextbookTime) {
  const auto d =
      duty(Sweep<double>{100, 50, 50, false, false}, 200.0, 0.25, 15.0, 4000.0, 0.25);
  EXPECT_NEAR(d.time_min, kPi * 50 * 100 / (1000 * 200 * 0.25), 1e-14);
  EXPECT_NEAR(d.edges, d.time_min / 15, 1e-14);
}

TEST(Grip, SpeedAndForceMeetAtTheLimit) {
  const Grip g{30000, 0.25, 0.2, 60};
  const double need = grip_needed_N(g, 1200.0, 500.0, 55.0);
  EXPECT_NEAR(need, 1.5 / 0.2 * std::hypot(1200 * 55 / 60.0, 500), 1e-9);
  const double n = grip_rpm(g, need);
  EXPECT_NEAR(g.force_N - grip_loss_N(g, n), need, 1e-6);
  EXPECT_NEAR(grip_loss_N(g, 3000.0), 0.25 * std::pow(kPi * 100, 2), 1e-9);
}

}  // namespace
}  // namespace turnwright::cutting
