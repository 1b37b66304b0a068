#include "turnwright/deflection/ring.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace turnwright::deflection {
namespace {

using std::numbers::pi;

const Ring kRing{40, 3e6};

/// Eq. (1) of ring.hpp, summed from the small end; what is left out is below
/// 1/(n^4 3 k^3) of it.
double series(const Ring& r, int jaws, double F, double t) {
  long double sum = 0;
  for (int k = 20000; k > 0; --k) {
    const long double m = static_cast<long double>(k) * jaws;
    sum += std::cos(m * t) / ((m * m - 1) * (m * m - 1));
  }
  return static_cast<double>(jaws * F * std::pow(r.R_mm, 3) / (pi * r.EI_Nmm2) * sum);
}

TEST(Ring, ClosedFormIsTheSeries) {
  for (const int jaws : {2, 3, 4, 6})
    for (const double t : {0.0, 0.3, 1.0, pi / 3, 2.0, pi, 4.0, -1.0, 7.0}) {
      const double lobe = lobing_mm(kRing, jaws, 2500);
      EXPECT_NEAR(squeeze_mm(kRing, jaws, 2500, t), series(kRing, jaws, 2500, t),
                  1e-11 * lobe)
          << jaws << " jaws at " << t;
    }
}

TEST(Ring, ThreeJawsLobeBy302TenThousandths) {
  // 0.0302 F R^3/(E I): half of the last digit
  EXPECT_NEAR(lobing_mm({1, 1}, 3, 1), 0.0302, 5e-5);
  EXPECT_NEAR(lobing_mm(kRing, 3, 5000),
              lobing_mm({1, 1}, 3, 1) * 5000 * 40 * 40 * 40 / 3e6, 1e-12);
}

TEST(Ring, TwoOpposedForcesAreTheTextbookRing) {
  // diameter shortens by F R^3/EI (pi/4 - 2/pi) along the forces and lengthens by
  // F R^3/EI (2/pi - 1/2) across them: handbook values
  EXPECT_NEAR(2 * squeeze_mm({1, 1}, 2, 1, 0), pi / 4 - 2 / pi, 1e-14);
  EXPECT_NEAR(2 * squeeze_mm({1, 1}, 2, 1, pi / 2), 0.5 - 2 / pi, 1e-14);
}

TEST(Ring, NoStretchOnAverageAndLargestInwardsAtTheJaws) {
  for (const int jaws : {3, 6}) {
    double mean = 0, largest = 0;
    const int n = 3600;
    for (int i = 0; i < n; ++i) {
      const double w = squeeze_mm(kRing, jaws, 2500, 2 * pi * (i + 0.5) / n);
      mean += w / n;
      largest = std::max(largest, w);
    }
    EXPECT_NEAR(mean, 0, 1e-5 * largest);
    EXPECT_LE(largest, squeeze_mm(kRing, jaws, 2500, 0));
    EXPECT_LT(squeeze_mm(kRing, jaws, 2500, pi / jaws), 0);
  }
}

TEST(Ring, SixJawsSqueezeNineteenTimesLess) {
  // the same total force on twice as many jaws: (6^2 - 1)^2/(3^2 - 1)^2 = 19.1 in the
  // first terms, which make 98.8 % of the lobes
  EXPECT_NEAR(lobing_mm(kRing, 3, 1000) / lobing_mm(kRing, 6, 500),
              35.0 * 35.0 / (8.0 * 8.0), 0.1);
}

TEST(Ring, WallOfARectangle) { EXPECT_EQ(wall_EI_Nmm2(210000, 20, 6), 210000 * 360.0); }

TEST(Ring, RefusesWhatIsNoRing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(squeeze_mm({0, 1}, 3, 1, 0), std::domain_error);
  EXPECT_THROW(squeeze_mm({1, nan}, 3, 1, 0), std::domain_error);
  EXPECT_THROW(squeeze_mm({1, 1}, 1, 1, 0), std::domain_error);
  EXPECT_THROW(squeeze_mm({1, 1}, 3, nan, 0), std::domain_error);
  EXPECT_THROW(lobing_mm({1, 0}, 3, 1), std::domain_error);
  EXPECT_THROW(wall_EI_Nmm2(210000, 0, 6), std::domain_error);
}

// sigma = m M/a^2 for unit width: the hyperbolic column of the table of
// [Timoshenko and Goodier 1970, art. 29], and how near it is to their exact one.
TEST(Ring, BentWallsHaveTheStressesOfTheTable) {
  struct Row {
    double ratio, inner, outer, exact_inner, exact_outer;
  };
  for (const auto& r :
       {Row{1.3, 72.98, -61.27, 73.05, -61.35}, Row{2, 7.725, -4.863, 7.755, -4.917},
        Row{3, 2.285, -1.095, 2.292, -1.130}}) {
    const auto s = bent_wall(2, 2 * r.ratio, 1, 1);
    EXPECT_NEAR(s.inner_MPa, r.inner, 6e-4 * r.inner);
    EXPECT_NEAR(s.outer_MPa, r.outer, -6e-4 * r.outer);
    EXPECT_NEAR(s.inner_MPa, r.exact_inner, 0.005 * r.exact_inner);
    EXPECT_NEAR(s.outer_MPa, r.exact_outer, -0.032 * r.exact_outer);
  }
}

// The couple from the curvature (w'' + w)/R^2 of the ring's own deflection.
TEST(Ring, SqueezedWallsBendAsTheirDeflectionSays) {
  const double R = 40, t = 0.4, b = 7, F = 30, E = 2e5;
  const Ring thin{R, wall_EI_Nmm2(E, b, t)};
  for (const int jaws : {2, 3, 4}) {
    const double h = 1e-3, alpha = pi / jaws;
    const auto w = [&](double a) { return squeeze_mm(thin, jaws, F, a); };
    const auto couple = [&](double a) {
      return thin.EI_Nmm2 / (R * R) * ((w(a + h) - 2 * w(a) + w(a - h)) / (h * h) + w(a));
    };
    // Beside the jaw, where the curvature has a corner, from the inside.
    const double jaw = 2 * couple(2 * h) - couple(4 * h);
    const double N = F / 2 / std::tan(alpha), W = b * t * t / 6;
    const auto s = squeezed_wall(2 * R - t, 2 * R + t, b, jaws, F);
    EXPECT_NEAR(s.inner_MPa, -jaw / W - N / (b * t), 0.01 * std::abs(jaw / W)) << jaws;
    EXPECT_GT(-jaw, std::abs(couple(alpha)));
  }
  // Three jaws: 0.1888 F R, a known number.
  EXPECT_NEAR(squeezed_wall(2 * R - t, 2 * R + t, b, 3, F).inner_MPa,
              0.1888 * F * R / (b * t * t / 6), 0.01 * 0.1888 * F * R / (b * t * t / 6));
}

TEST(Ring, RefusesWallsThatAreNone) {
  EXPECT_THROW(bent_wall(0, 2, 1, 1), std::domain_error);
  EXPECT_THROW(bent_wall(2, 2, 1, 1), std::domain_error);
  EXPECT_THROW(bent_wall(1, 2, 0, 1), std::domain_error);
  EXPECT_THROW(bent_wall(1, 2, 1, NAN), std::domain_error);
  EXPECT_THROW(squeezed_wall(1, 2, 1, 1, 1), std::domain_error);
}

}  // namespace
}  // namespace turnwright::deflection
