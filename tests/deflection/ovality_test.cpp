#include "turnwright/deflection/ovality.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace turnwright::deflection {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();

/// The section counted out in small squares.
Section counted(double R, const std::vector<Slot>& slots) {
  Section s;
  const int n = 3000;
  const double h = 2 * R / n, dA = h * h;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double x = (i + 0.5) * h - R, y = (j + 0.5) * h - R;
      bool in = x * x + y * y < R * R;
      for (const Slot& k : slots) {
        const double c = std::cos(k.angle_rad), d = std::sin(k.angle_rad);
        in = in &&
             !(x * c + y * d > k.floor_mm && std::abs(-x * d + y * c) < k.width_mm / 2);
      }
      if (!in) continue;
      s.area_mm2 += dA, s.sx_mm3 += x * dA, s.sy_mm3 += y * dA;
      s.xx_mm4 += x * x * dA, s.yy_mm4 += y * y * dA, s.xy_mm4 += x * y * dA;
    }
  return s;
}

TEST(Ovality, MomentsOfASlotAreThoseOfTheCountedSection) {
  const double R = 20;
  for (const Slot& slot : {Slot{8, 15, 0}, Slot{12, 14, 0.7}, Slot{3, 2, 2.1}}) {
    const Section got = without_slot(round_section(2 * R), 2 * R, slot);
    const Section expected = counted(R, {slot});
    // squares on the rim: a few parts in 1e5 of the disc
    EXPECT_NEAR(got.area_mm2, expected.area_mm2, 5e-5 * kPi * R * R);
    EXPECT_NEAR(got.sx_mm3, expected.sx_mm3, 5e-5 * kPi * R * R * R);
    EXPECT_NEAR(got.sy_mm3, expected.sy_mm3, 5e-5 * kPi * R * R * R);
    const double I = kPi * R * R * R * R / 4;
    EXPECT_NEAR(got.xx_mm4, expected.xx_mm4, 1e-4 * I);
    EXPECT_NEAR(got.yy_mm4, expected.yy_mm4, 1e-4 * I);
    EXPECT_NEAR(got.xy_mm4, expected.xy_mm4, 1e-4 * I);
  }
}

TEST(Ovality, AFlatThroughTheAxisLeavesHalfADisc) {
  // area pi R^2/2, centroid 4 R/3 pi from the axis, pi R^4/8 about any diameter
  const double R = 15;
  const Section half = without_flat(round_section(2 * R), 2 * R, 0, kPi / 3);
  EXPECT_NEAR(half.area_mm2 / (kPi * R * R / 2), 1, 1e-14);
  EXPECT_NEAR(half.sx_mm3, -2 * R * R * R / 3 * std::cos(kPi / 3), 1e-10);
  EXPECT_NEAR(half.sy_mm3, -2 * R * R * R / 3 * std::sin(kPi / 3), 1e-10);
  EXPECT_NEAR(half.xx_mm4 / (kPi * R * R * R * R / 8), 1, 1e-13);
  EXPECT_NEAR(half.yy_mm4 / (kPi * R * R * R * R / 8), 1, 1e-13);
  EXPECT_NEAR(half.xy_mm4, 0, 1e-9);
}

const Root kRoot{1.8e-5, 8.6e-8, 1.1e-9};

// Half a disc: R^4 (pi/8 - 8/(9 pi)) about its centroid, less than pi R^4/8 across.
TEST(Ovality, LeastSecondMomentIsThatOfHalfADiscAboutItsCentroid) {
  const double R = 10;
  for (const double angle : {0.0, 0.7, 2.9}) {
    const Section half = without_flat(round_section(2 * R), 2 * R, 0, angle);
    EXPECT_NEAR(least_second_moment_mm4(half), 1e4 * (kPi / 8 - 8 / (9 * kPi)), 1e-9);
  }
  EXPECT_DOUBLE_EQ(least_second_moment_mm4(round_section(2 * R, R)),
                   kPi / 64 * (16e4 - 1e4));
  EXPECT_THROW(least_second_moment_mm4({}), std::domain_error);
}

TEST(Ovality, RoundSectionsAreTheBeamWithoutLobes) {
  // slender: shear is 1e-12 of the deflection
  const part::Shaft wire{210000, 0, {{4e5, 0.4, 0.4, 0, 0}, {3e5, 0.3, 0.3, 0.1, 0.1}}};
  const std::vector<Stretch> stretches{{4e5, round_section(0.4)},
                                       {3e5, round_section(0.3, 0.1)}};
  const Beam beam(wire);
  for (const Method m : {Method::chuck, Method::between_centres, Method::chuck_tailstock})
    for (const double a : {1e5, 4e5, 5e5}) {
      const Supports s{m, {1e3, 2e-3, 1e-8}, 5e3, 7e3};
      const OvalFlexibility f = oval_flexibility(stretches, 210000, s, a);
      EXPECT_NEAR(f.mean_mm_N / beam.at(a, s).f_ww_mm_N, 1, 1e-9);
      EXPECT_NEAR(f.lobe_mm_N, 0, 1e-12 * f.mean_mm_N);
    }
}

TEST(Ovality, ThreeKeywaysAreAsGoodAsRound) {
  Section s = round_section(40), one = s;
  for (int k = 0; k < 3; ++k) s = without_slot(s, 40, {10, 15, 0.3 + 2 * kPi / 3 * k});
  one = without_slot(one, 40, {10, 15, 0.3});
  const OvalFlexibility three =
      oval_flexibility(std::vector<Stretch>{{200, s}}, 210000, {}, 200);
  const OvalFlexibility keyway =
      oval_flexibility(std::vector<Stretch>{{200, one}}, 210000, {}, 200);
  EXPECT_LT(three.lobe_mm_N, 1e-14 * three.mean_mm_N);
  EXPECT_GT(keyway.lobe_mm_N, 0.02 * keyway.mean_mm_N);
  // the keyway stands in the soft direction
  EXPECT_NEAR(keyway.softest_rad, 0.3, 1e-12);
}

TEST(Ovality, AFlatBarIsTheTextbookCantileverBothWays) {
  // two opposed flats; 1/I one way, 1/I the other
  Section s = round_section(30);
  s = without_flat(without_flat(s, 30, 10, kPi / 2), 30, 10, -kPi / 2);
  EXPECT_NEAR(s.sy_mm3, 0, 1e-9);
  const OvalFlexibility f =
      oval_flexibility(std::vector<Stretch>{{150, s}}, 210000, {}, 150);
  const double along = 150 * 150 * 150 / (3 * 210000 * s.xx_mm4);
  const double across = 150 * 150 * 150 / (3 * 210000 * s.yy_mm4);
  EXPECT_NEAR(f.mean_mm_N + f.lobe_mm_N, across, 1e-12 * across);
  EXPECT_NEAR(f.mean_mm_N - f.lobe_mm_N, along, 1e-12 * across);
  EXPECT_NEAR(f.softest_rad, kPi / 2, 1e-12);
}

std::vector<Stretch> keyed() {
  const Section disc = round_section(40);
  return {{60, disc},
          {80, without_slot(disc, 40, {12, 15, 0.4})},
          {40, without_flat(round_section(30), 30, 10, 1.9)}};
}

/// Deflection vector of a force vector by integrating w'' in both planes at once, E T u''
/// = m, with the tail's reaction found so that the tail stays where it is.
std::array<double, 2> shot(const std::vector<Stretch>& parts, double a,
                           std::array<double, 2> F, std::array<double, 2> reaction,
                           double place) {
  std::array<double, 2> u{}, slope{};
  double start = 0, L = 0;
  for (const Stretch& s : parts) L += s.length_mm;
  for (const Stretch& s : parts) {
    const Section& q = s.section;
    const double xx = q.xx_mm4 - q.sx_mm3 * q.sx_mm3 / q.area_mm2;
    const double yy = q.yy_mm4 - q.sy_mm3 * q.sy_mm3 / q.area_mm2;
    const double xy = q.xy_mm4 - q.sx_mm3 * q.sy_mm3 / q.area_mm2;
    const double det = xx * yy - xy * xy;
    const double h = 0.02;  // every length and place is a multiple
    const long n = std::lround((std::min(start + s.length_mm, place) - start) / h);
    for (long i = 0; i < n; ++i) {
      const double z = start + (static_cast<double>(i) + 0.5) * h;
      double m[2];
      for (std::size_t k = 0; k < 2; ++k) {
        const double force = z < a ? F[k] * (a - z) : 0;
        m[k] = force - reaction[k] * (L - z);
      }
      const double c0 = (yy * m[0] - xy * m[1]) / det / 210000;
      const double c1 = (xx * m[1] - xy * m[0]) / det / 210000;
      u[0] += slope[0] * h + c0 * h * h / 2, slope[0] += c0 * h;
      u[1] += slope[1] * h + c1 * h * h / 2, slope[1] += c1 * h;
    }
    start += s.length_mm;
  }
  return u;
}

TEST(Ovality, ChuckAndTailstockByIntegratingBothPlanes) {
  const auto parts = keyed();
  for (const double a : {50.0, 110.0, 160.0})
    for (const bool tail : {false, true})
      for (const double psi : {0.0, 0.4, 1.3, 2.5}) {
        const std::array<double, 2> n{std::cos(psi), std::sin(psi)};
        std::array<double, 2> R{};
        if (tail) {  // u(L) = 0 is linear in R
          const auto free = shot(parts, a, n, {0, 0}, 180);
          const auto x = shot(parts, a, {0, 0}, {1, 0}, 180),
                     y = shot(parts, a, {0, 0}, {0, 1}, 180);
          const double det = x[0] * y[1] - y[0] * x[1];
          R = {-(free[0] * y[1] - y[0] * free[1]) / det,
               -(x[0] * free[1] - free[0] * x[1]) / det};
        }
        const auto u = shot(parts, a, n, R, a);
        const OvalFlexibility f = oval_flexibility(
            parts, 210000, {tail ? Method::chuck_tailstock : Method::chuck, {}, 0, 0}, a);
        const double got =
            f.mean_mm_N + f.lobe_mm_N * std::cos(2 * (psi - f.softest_rad));
        EXPECT_NEAR(got, u[0] * n[0] + u[1] * n[1], 1e-6 * f.mean_mm_N)
            << a << ' ' << tail << ' ' << psi;
      }
}

TEST(Ovality, BetweenCentresIsTheMirrorOfItself) {
  auto parts = keyed();
  const OvalFlexibility f =
      oval_flexibility(parts, 210000, {Method::between_centres, {}, 1e-5, 2e-5}, 70);
  std::swap(parts[0], parts[2]);
  const OvalFlexibility g =
      oval_flexibility(parts, 210000, {Method::between_centres, {}, 2e-5, 1e-5}, 110);
  EXPECT_NEAR(g.mean_mm_N / f.mean_mm_N, 1, 1e-13);
  EXPECT_NEAR(g.lobe_mm_N / f.lobe_mm_N, 1, 1e-12);
  EXPECT_NEAR(g.softest_rad, f.softest_rad, 1e-12);
}

TEST(Ovality, TurningThePartTurnsTheSoftDirectionAlone) {
  const auto flex = [](double by) {
    const Section disc = round_section(40);
    const std::vector<Stretch> parts{
        {60, without_slot(disc, 40, {12, 15, 0.4 + by})},
        {90, without_flat(round_section(30), 30, 10, 1.2 + by)}};
    return oval_flexibility(parts, 210000, {Method::chuck_tailstock, kRoot, 0, 3e-5}, 90);
  };
  const OvalFlexibility f = flex(0), g = flex(0.25);
  EXPECT_NEAR(g.mean_mm_N / f.mean_mm_N, 1, 1e-12);
  EXPECT_NEAR(g.lobe_mm_N / f.lobe_mm_N, 1, 1e-11);
  EXPECT_NEAR(std::remainder(g.softest_rad - f.softest_rad - 0.25, kPi), 0, 1e-11);
}

TEST(Ovality, ErrorOverARevolutionUnderBothForces) {
  const OvalFlexibility f =
      oval_flexibility(keyed(), 210000, {Method::chuck, kRoot, 0, 0}, 170);
  // C from its mean and lobe, the forces turned through the part
  const double p = f.lobe_mm_N * std::cos(2 * f.softest_rad),
               q = f.lobe_mm_N * std::sin(2 * f.softest_rad), m = f.mean_mm_N;
  double high = -1e9, low = 1e9, sum = 0;
  const int n = 20000;
  for (int i = 0; i < n; ++i) {
    const double psi = 2 * kPi * i / n, c = std::cos(psi), s = std::sin(psi);
    const double Fx = 300 * c - 700 * s, Fy = 300 * s + 700 * c;
    const double e = c * ((m + p) * Fx + q * Fy) + s * (q * Fx + (m - p) * Fy);
    high = std::max(high, e), low = std::min(low, e), sum += e / n;
  }
  const OvalError e = oval_error(f, 300, 700);
  EXPECT_NEAR(e.mean_mm, sum, 1e-12);
  EXPECT_NEAR(2 * e.amplitude_mm, high - low, 1e-6 * e.amplitude_mm);
}

TEST(Ovality, RefusesWhatIsNoSection) {
  EXPECT_THROW(round_section(0), std::domain_error);
  EXPECT_THROW(round_section(10, 10), std::domain_error);
  const Section disc = round_section(40);
  for (const Slot& slot :
       {Slot{0, 15, 0}, Slot{41, 0, 0}, Slot{10, -1, 0}, Slot{10, 19.9, 0},
        Slot{kUndefined, 15, 0}, Slot{10, kUndefined, 0}})
    EXPECT_THROW(without_slot(disc, 40, slot), std::domain_error);
  EXPECT_THROW(without_flat(disc, 40, 21, 0), std::domain_error);
  const std::vector<Stretch> good{{100, disc}};
  EXPECT_THROW(oval_flexibility(good, 0, {}, 50), std::domain_error);
  EXPECT_THROW(oval_flexibility(good, 210000, {}, 101), std::domain_error);
  EXPECT_THROW(oval_flexibility(good, 210000, {}, kUndefined), std::domain_error);
  EXPECT_THROW(oval_flexibility(std::vector<Stretch>{{100, Section{}}}, 210000, {}, 50),
               std::domain_error);
  EXPECT_THROW(oval_flexibility(std::vector<Stretch>{{0, disc}}, 210000, {}, 0),
               std::domain_error);
  EXPECT_THROW(oval_flexibility(good, 210000, {Method::chuck, {1, 1.1, 1}, 0, 0}, 50),
               std::domain_error);
}

}  // namespace
}  // namespace turnwright::deflection
