#include "turnwright/deflection/boring_bar.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <stdexcept>

namespace turnwright::deflection {
namespace {

using std::numbers::pi;

TEST(BoringBar, UniformBarIsTheTextbooks) {
  const double E = 210000, nu = 0.3, L = 100, d = 25, f = 13;
  const double EI = E * pi * d * d * d * d / 64, G = E / (2 * (1 + nu));
  const double GJ = G * pi * d * d * d * d / 32;
  const double shear = L * (7 + 6 * nu) / (6 * (1 + nu)) / (G * pi * d * d / 4);
  const double f_ww = L * L * L / (3 * EI) + shear;
  const Load load{300, 700, 200};
  const BarTip tip = bar_tip(Beam({E, nu, {{L, d, d, 0, 0}}}), {}, {f, 60}, load);
  EXPECT_NEAR(tip.twist_rad_Nmm / (L / GJ), 1, 1e-13);
  const double y_r = f_ww * 300 - L * L / (2 * EI) * 200 * f;
  const double y_t = f_ww * 700 + 700 * f * f * L / GJ;
  EXPECT_NEAR(tip.y_r_mm / y_r, 1, 1e-13);
  EXPECT_NEAR(tip.y_t_mm / y_t, 1, 1e-13);
  EXPECT_NEAR(tip.bore_radius_error_mm, -y_r + y_t * y_t / 60, 1e-16);
}

TEST(BoringBar, TheToolBlockGivesWayToo) {
  const Beam bar({210000, 0.3, {{100, 25, 25, 0, 0}}});
  const Root r{1e-5, 2e-8, 5e-10}, t{2e-5, 3e-8, 6e-10};
  const Clamping block{{.root = r}, {.method = Method::chuck_tailstock, .root = t}};
  const Load load{300, 700, 200};
  const BarTip soft = bar_tip(bar, block, {13, 60}, load),
               rigid = bar_tip(bar, {}, {13, 60}, load);
  EXPECT_NEAR(
      soft.y_r_mm - rigid.y_r_mm,
      300 * (1e-5 + 2 * 2e-8 * 100 + 5e-10 * 1e4) - 200 * 13 * (2e-8 + 5e-10 * 100),
      1e-15);
  EXPECT_NEAR(soft.y_t_mm - rigid.y_t_mm, 700 * (2e-5 + 2 * 3e-8 * 100 + 6e-10 * 1e4),
              1e-15);
  EXPECT_EQ(soft.twist_rad_Nmm, rigid.twist_rad_Nmm);
}

TEST(BoringBar, NecksAndCoolantBoresAreIntegratedPieceByPiece) {
  // shank 32 mm with a 10 mm bore, neck 25 mm with a 6 mm bore: unit loads at the tip
  const double E = 600000, nu = 0.22, G = E / (2 * (1 + nu));
  const struct { double h, D, d; } parts[] = {{80, 32, 10}, {40, 25, 6}};
  part::Shaft shaft{E, nu, {}};
  double bend = 0, turn = 0, shear = 0, twist = 0, z = 0;
  for (const auto& [h, D, d] : parts) {
    shaft.segments.push_back({h, D, D, d, d});
    const double I = pi * (D * D * D * D - d * d * d * d) / 64,
                 A = pi * (D * D - d * d) / 4;
    const double m2 = d * d / (D * D), n = (1 + m2) * (1 + m2);
    const double chi = ((7 + 6 * nu) * n + (20 + 12 * nu) * m2) / (6 * (1 + nu) * n);
    const double p = 120 - z, q = p - h;  // arms of the ends
    bend += (p * p * p - q * q * q) / (3 * E * I);
    turn += (p * p - q * q) / (2 * E * I);
    shear += chi * h / (G * A);
    twist += h / (G * 2 * I);
    z += h;
  }
  const Load load{250, 600, 150};
  const BarTip tip = bar_tip(Beam(shaft), {}, {17, 48}, load);
  EXPECT_NEAR(tip.y_r_mm / ((bend + shear) * 250 - turn * 150 * 17), 1, 1e-13);
  EXPECT_NEAR(tip.y_t_mm / ((bend + shear + 17 * 17 * twist) * 600), 1, 1e-13);
}

TEST(BoringBar, AMeasuredComplianceStandsForShankAndHolder) {
  const Beam bar({210000, 0.3, {{100, 25, 25, 0, 0}}});
  const Load load{300, 700, 200};
  const Clamping block{{.root = {1e-5, 2e-8, 5e-10}}, {.root = {2e-5, 3e-8, 6e-10}}};
  const BarTip drawn = bar_tip(bar, {}, {13, 60}, load),
               measured = bar_tip(bar, {}, {13, 60, 4e-5}, load);
  const double f_ww = bar.at(100, {}).f_ww_mm_N;
  EXPECT_NEAR(measured.y_r_mm - drawn.y_r_mm, (4e-5 - f_ww) * 300, 1e-16);
  EXPECT_NEAR(measured.y_t_mm - drawn.y_t_mm, (4e-5 - f_ww) * 700, 1e-16);
  EXPECT_EQ(bar_tip(bar, block, {13, 60, 4e-5}, {300, 700, 0}).y_r_mm, 4e-5 * 300);
  EXPECT_THROW(bar_tip(bar, {}, {13, 60, -1e-6}, load), std::domain_error);
  EXPECT_THROW(bar_tip(bar, {}, {13, 60, std::numeric_limits<double>::quiet_NaN()}, load),
               std::domain_error);
}

TEST(BoringBar, RefusesWhatIsNoBore) {
  const Beam bar({210000, 0.3, {{100, 25, 25, 0, 0}}});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const BoringBar& at :
       {BoringBar{13, 0}, BoringBar{-1, 60}, BoringBar{nan, 60}, BoringBar{13, nan}})
    EXPECT_THROW(bar_tip(bar, {}, at, {}), std::domain_error);
}

}  // namespace
}  // namespace turnwright::deflection
