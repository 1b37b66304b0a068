#include "turnwright/tolerance/piecewise.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>

namespace turnwright::tolerance {
namespace {

PiecewisePolynomial one_piece(double from_mm, double to_mm, std::vector<double> c) {
  return {.breaks_mm = {from_mm, to_mm}, .coefficients = {std::move(c)}};
}

/// Coefficients of Chebyshev's T_n((2 s - h)/h) in s, by its recurrence.
std::vector<double> chebyshev(int n, double h) {
  std::vector<double> a{1}, b{-1, 2 / h};
  if (n == 0) return a;
  for (int k = 2; k <= n; ++k) {
    std::vector<double> next(b.size() + 1, 0.0);
    for (std::size_t j = 0; j < b.size(); ++j) {
      next[j] -= 2 * b[j];
      next[j + 1] += 4 / h * b[j];
    }
    for (std::size_t j = 0; j < a.size(); ++j) next[j] -= a[j];
    a = std::exchange(b, next);
  }
  return b;
}

TEST(Extremes, OfSamplesAreTheSamples) {
  const auto e = extremes(Samples{.e_mm = {0.004, 0.011, -0.002}});
  EXPECT_EQ(e.min_mm, -0.002);
  EXPECT_EQ(e.max_mm, 0.011);
}

// e = 4 s (20 - s)/400 um-like parabola: top 1 in the middle, no sample needed there.
TEST(Extremes, FindTheTopBetweenTheEnds) {
  const auto e = extremes(one_piece(30, 50, {0, 0.2, -0.01}));
  EXPECT_EQ(e.min_mm, 0);
  EXPECT_NEAR(e.max_mm, 1, 1e-15);
}

// The local variable starts at the piece's own break: the same bump anywhere.
TEST(Extremes, CoefficientsBelongToThePiece) {
  for (const double z : {0.0, 30.0, 1000.0}) {
    const auto e = extremes(PiecewisePolynomial{.breaks_mm = {z, z + 10, z + 20},
                                                .coefficients = {{1}, {1, 0.4, -0.04}}});
    EXPECT_EQ(e.min_mm, 1);
    EXPECT_NEAR(e.max_mm, 2, 1e-14);
  }
}

TEST(Extremes, BothSidesOfAStepCount) {
  const auto e = extremes(PiecewisePolynomial{.breaks_mm = {0, 10, 20},
                                              .coefficients = {{0, 0.1}, {-2, 0.1}}});
  EXPECT_EQ(e.min_mm, -2);
  EXPECT_EQ(e.max_mm, 1);
}

// T_n turns n - 1 times between -1 and 1: all of it must be found, whatever the degree.
TEST(Extremes, OfChebyshevPolynomialsAreOne) {
  for (int n = 1; n <= 14; ++n) {
    const auto f = one_piece(5, 12, chebyshev(n, 7));
    const auto e = extremes(f);
    const double rounding = 4e-16 * magnitude_mm(f);
    EXPECT_NEAR(e.max_mm, 1, rounding) << n;
    EXPECT_NEAR(e.min_mm, -1, rounding) << n;
  }
}

// An inflection with a level tangent and a double root of e' are no extremes, a flat
// piece is.
TEST(Extremes, DegeneratePieces) {
  // (s - 1)^3 on [0, 2]
  auto e = extremes(one_piece(0, 2, {-1, 3, -3, 1}));
  EXPECT_EQ(e.min_mm, -1);
  EXPECT_NEAR(e.max_mm, 1, 1e-15);
  // (s - 1)^4 - 1, root of e' threefold
  e = extremes(one_piece(0, 3, {0, -4, 6, -4, 1}));
  EXPECT_NEAR(e.min_mm, -1, 1e-14);
  EXPECT_NEAR(e.max_mm, 15, 1e-13);
  e = extremes(one_piece(0, 2, {0, -4, 6, -4, 1}));  // the root is hit exactly
  EXPECT_EQ(e.min_mm, -1);
  EXPECT_EQ(e.max_mm, 0);
  e = extremes(one_piece(0, 3, {0.25, 0, 0}));
  EXPECT_EQ(e.min_mm, 0.25);
  EXPECT_EQ(e.max_mm, 0.25);
}

// 1e6 evaluations of the curve never leave the extremes and come as close as their
// spacing allows: an independent method.
TEST(Extremes, HoldEveryPointOfRandomCurves) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int trial = 0; trial < 50; ++trial) {
    PiecewisePolynomial f{.breaks_mm = {0}, .coefficients = {}};
    for (int k = 0; k < 4; ++k) {
      f.breaks_mm.push_back(f.breaks_mm.back() + 1.5 + number(random));
      std::vector<double> c(static_cast<std::size_t>(1 + trial % 7));
      for (double& x : c) x = number(random);
      f.coefficients.push_back(c);
    }
    const auto e = extremes(f);
    double low = 1e9, high = -1e9;
    for (std::size_t k = 0; k < 4; ++k)
      for (int i = 0; i <= 5000; ++i) {
        const double s = (f.breaks_mm[k + 1] - f.breaks_mm[k]) * i / 5000;
        double y = 0;
        for (std::size_t j = f.coefficients[k].size(); j-- > 0;)
          y = y * s + f.coefficients[k][j];
        low = std::min(low, y);
        high = std::max(high, y);
      }
    const double rounding = 1e-15 * magnitude_mm(f);
    EXPECT_LE(e.min_mm, low + rounding);
    EXPECT_GE(e.max_mm, high - rounding);
    EXPECT_NEAR(e.min_mm, low, 3e-5);  // e'' (h/10000)^2/2, e'' < 2000
    EXPECT_NEAR(e.max_mm, high, 3e-5);
  }
}

TEST(MinimumZone, OfAStraightLineIsNothing) {
  EXPECT_NEAR(minimum_zone(one_piece(10, 90, {0.01, 3e-4})).width_mm, 0, 1e-17);
  EXPECT_NEAR(minimum_zone(Samples{.e_mm = {0.1, 0.2, 0.3, 0.4}}).width_mm, 0, 1e-16);
  EXPECT_EQ(minimum_zone(Samples{.e_mm = {0.1}}).width_mm, 0);
  EXPECT_NEAR(minimum_zone(Samples{.e_mm = {0.1, 0.4}}).width_mm, 0, 1e-16);
}

// Chebyshev: the least-deviating monic parabola on a length h is h^2/4 wide, whatever
// line is added; the cubic with no line in it is h^3/16 wide.
TEST(MinimumZone, OfParabolaAndCubicAreChebyshevs) {
  for (const double h : {1.0, 40.0}) {
    const auto parabola = minimum_zone(one_piece(7, 7 + h, {0.3, -2, 1}));
    EXPECT_NEAR(parabola.width_mm / (h * h / 4), 1, 1e-12) << h;
    EXPECT_NEAR(parabola.slope, h - 2, 1e-6 * h);
    // s^3 less its best parabola is T_3; the parabola is given along: s^3 - 1.5 h s^2.
    const auto cubic = minimum_zone(one_piece(0, h, {1, 5, -1.5 * h, 1}));
    EXPECT_NEAR(cubic.width_mm / (h * h * h / 16), 1, 1e-12) << h;
  }
}

// No line comes nearer to T_n than zero: T_n and any line is 2 wide.
TEST(MinimumZone, OfChebyshevPolynomialsIsTwo) {
  for (int n = 2; n <= 12; ++n)
    for (const double slope : {-3.0, -0.1, 0.02, 0.7, 40.0}) {
      auto f = one_piece(5, 12, chebyshev(n, 7));
      f.coefficients[0][0] += 0.3;
      f.coefficients[0][1] += slope;
      const auto zone = minimum_zone(f);
      const double rounding = 1e-15 * magnitude_mm(f);
      EXPECT_NEAR(zone.width_mm, 2, 2e-12 + rounding) << n << ' ' << slope;
      // e is flat at its extremes: the slope is known to the root of the width only.
      EXPECT_NEAR(zone.slope, slope, 1e-5 + std::sqrt(rounding)) << n;
    }
}

// Two equal bumps: the line rests on both, the zone is one bump high.
TEST(MinimumZone, OfSeveralPieces) {
  const PiecewisePolynomial f{.breaks_mm = {0, 10, 20},
                              .coefficients = {{0, 0.04, -0.004}, {0, 0.04, -0.004}}};
  EXPECT_NEAR(minimum_zone(f).width_mm, 0.1, 1e-14);
  EXPECT_NEAR(minimum_zone(f).slope, 0, 1e-12);
}

TEST(MinimumZone, OfSamplesRestsOnAnEdge) {
  EXPECT_NEAR(minimum_zone(Samples{.e_mm = {0, 1, 0}}).width_mm, 1, 1e-15);
  // Points (0,0) (1,3) (4,0): line through the first and last below, the top 3 above.
  EXPECT_NEAR(minimum_zone(Samples{.z_mm = {0, 1, 4}, .e_mm = {0, 3, 0}}).width_mm, 3,
              1e-15);
  // (0,0) (1,3) (4,4): below rests on (0,0)-(4,4), slope 1, 2 high.
  EXPECT_NEAR(minimum_zone(Samples{.z_mm = {0, 1, 4}, .e_mm = {0, 3, 4}}).width_mm, 2,
              1e-15);
  EXPECT_NEAR(minimum_zone(Samples{.z_mm = {0, 1, 4}, .e_mm = {0, 3, 4}}).slope, 1,
              1e-15);
  // A step at one place cannot be turned away.
  EXPECT_NEAR(minimum_zone(Samples{.z_mm = {0, 0}, .e_mm = {0, 3}}).width_mm, 3, 1e-15);
}

/// Width of (2) at one slope, over many points of the curve.
double width_at(const std::vector<double>& x, const std::vector<double>& y, double a) {
  double low = 1e9, high = -1e9;
  for (std::size_t i = 0; i < x.size(); ++i) {
    low = std::min(low, y[i] - a * x[i]);
    high = std::max(high, y[i] - a * x[i]);
  }
  return high - low;
}

/// The least of a convex function of a: golden section, independent of hulls.
double least_width(const std::vector<double>& x, const std::vector<double>& y) {
  const double g = (std::sqrt(5.0) - 1) / 2;
  double a = -100, b = 100;
  for (int i = 0; i < 90; ++i) {
    const double c = b - g * (b - a), d = a + g * (b - a);
    (width_at(x, y, c) < width_at(x, y, d) ? b : a) =
        width_at(x, y, c) < width_at(x, y, d) ? d : c;
  }
  return width_at(x, y, 0.5 * (a + b));
}

TEST(MinimumZone, AgreesWithGoldenSection) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int trial = 0; trial < 40; ++trial) {
    PiecewisePolynomial f{.breaks_mm = {0}, .coefficients = {}};
    std::vector<double> x, y;
    for (std::size_t k = 0; k < 3; ++k) {
      f.breaks_mm.push_back(f.breaks_mm.back() + 1.5 + number(random));
      std::vector<double> c(static_cast<std::size_t>(3 + trial % 4));
      for (double& v : c) v = number(random);
      f.coefficients.push_back(c);
      for (int i = 0; i <= 1000; ++i) {
        const double s = (f.breaks_mm[k + 1] - f.breaks_mm[k]) * i / 1000;
        double e = 0;
        for (std::size_t j = c.size(); j-- > 0;) e = e * s + c[j];
        x.push_back(std::min(f.breaks_mm[k] + s, f.breaks_mm[k + 1]));
        y.push_back(e);
      }
    }
    const double sampled = least_width(x, y);
    EXPECT_NEAR(minimum_zone(Samples{.z_mm = x, .e_mm = y}).width_mm / sampled, 1, 1e-9);
    const auto zone = minimum_zone(f);
    EXPECT_GE(zone.width_mm, sampled - 1e-9);
    EXPECT_NEAR(zone.width_mm, sampled, 2e-4);  // e'' (h/2000)^2, e'' < 100
    EXPECT_NEAR(width_at(x, y, zone.slope), zone.width_mm, 2e-4);
  }
}

// A line added to e changes nothing, a mirrored or scaled e and a longer z do as they
// must.
TEST(MinimumZone, Invariances) {
  const auto f = one_piece(3, 25, {0.2, -0.01, 4e-3, -3e-4, 6e-6});
  const double w = minimum_zone(f).width_mm;
  auto tilted = f;
  tilted.coefficients[0][0] += 0.7;
  tilted.coefficients[0][1] += 0.03;
  EXPECT_NEAR(minimum_zone(tilted).width_mm / w, 1, 1e-11);
  auto mirrored = f;
  for (double& c : mirrored.coefficients[0]) c = -c;
  EXPECT_NEAR(minimum_zone(mirrored).width_mm / w, 1, 1e-12);
  auto stretched = f;  // z three times as long
  stretched.breaks_mm[1] = 3 + 66;
  for (std::size_t j = 0; j < 5; ++j)
    stretched.coefficients[0][j] /= std::pow(3.0, static_cast<double>(j));
  EXPECT_NEAR(minimum_zone(stretched).width_mm / w, 1, 1e-12);
  EXPECT_LE(w, extremes(f).max_mm - extremes(f).min_mm);
}

std::string message(const Profile& profile) {
  try {
    check(profile);
  } catch (const std::domain_error& e) {
    return e.what();
  }
  return "accepted";
}

TEST(Profile, RefusesWhatIsNone) {
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(message(Samples{}), "profile: no error is given");
  EXPECT_EQ(message(PiecewisePolynomial{}), "profile: no error is given");
  EXPECT_EQ(message(Samples{.e_mm = {1, nan}}), "profile: e_mm must be finite");
  EXPECT_EQ(message(Samples{.z_mm = {0, inf}, .e_mm = {1, 2}}),
            "profile: z_mm must be finite");
  EXPECT_EQ(message(Samples{.z_mm = {0}, .e_mm = {1, 2}}),
            "profile: z_mm and e_mm must be equally many");
  EXPECT_EQ(message(Samples{.z_mm = {1, 0}, .e_mm = {1, 2}}),
            "profile: z_mm must not fall");
  EXPECT_EQ(message(PiecewisePolynomial{{0, 1}, {{1}, {2}}}),
            "profile: there must be one break more than pieces");
  EXPECT_EQ(message(one_piece(1, 1, {1})), "profile: breaks_mm must rise");
  EXPECT_EQ(message(one_piece(nan, 1, {1})), "profile: breaks_mm must be finite");
  EXPECT_EQ(message(one_piece(0, 1, {})), "profile: a piece has no coefficient");
  EXPECT_EQ(message(one_piece(0, 1, {nan})), "profile: coefficients must be finite");
  EXPECT_EQ(message(one_piece(0, 1e200, {0, 1e200})), "profile: e is not finite");
  EXPECT_THROW(extremes(Samples{}), std::domain_error);
  EXPECT_THROW(minimum_zone(Samples{}), std::domain_error);
}

}  // namespace
}  // namespace turnwright::tolerance
