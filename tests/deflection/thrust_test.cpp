#include "turnwright/deflection/thrust.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "random_shafts.hpp"

namespace turnwright::deflection {
namespace {

using std::numbers::pi;
// so slender that shear is nothing
const part::Shaft kWire{210000, 0, {{1e4, 1, 1, 0, 0}}};
const double kL = 1e4, kEI = 210000 * pi / 64;

TEST(Thrust, EulersCases) {
  EXPECT_NEAR(critical_thrust_N(kWire, {Method::between_centres, {}, 0, 0}) /
                  (pi * pi * kEI / (kL * kL)),
              1, 1e-4);
  // clamped and hinged: tan(u) = u, u = 4.4934094579
  EXPECT_NEAR(critical_thrust_N(kWire, {Method::chuck_tailstock, {}, 0, 0}) /
                  (4.4934094579 * 4.4934094579 * kEI / (kL * kL)),
              1, 1e-4);
}

TEST(Thrust, AChuckThatTurnsIsBetweenTheTwo) {
  // with the root's spring c2, v^2 = P L^2/EI: sin(v) (1 + v^2 c2 EI/L) = v cos(v),
  // derived here from w'' + k^2 w = R (L - z)
  for (const double ratio : {0.1, 1.0, 10.0}) {
    const double c2 = ratio * kL / kEI;
    double low = pi, high = 4.4934094579;  // pinned and clamped
    const auto value = [&](double v) {
      return std::sin(v) * (1 + v * v * ratio) - v * std::cos(v);
    };
    for (int i = 0; i < 200; ++i) {
      const double middle = (low + high) / 2;
      (value(middle) > 0 ? low : high) = middle;
    }
    EXPECT_NEAR(critical_thrust_N(kWire, {Method::chuck_tailstock, {0, 0, c2}, 0, 0}) /
                    (low * low * kEI / (kL * kL)),
                1, 1e-4)
        << ratio;
  }
}

TEST(Thrust, AStiffPartOnSoftCentresIsOverturned) {
  // a rigid bar (thick) on soft centres turns about them: the thrust that overturns it is
  // L/(c_h + c_t)
  const part::Shaft thick{210000, 0.3, {{300, 200, 200, 0, 0}}};
  const double c = 1e-3;
  EXPECT_NEAR(
      critical_thrust_N(thick, {Method::between_centres, {}, c, 2 * c}) / (300 / (3 * c)),
      1, 2e-4);
}

TEST(Thrust, BoundsTheBeamColumnEverywhereAndMeetsItInTheMiddle) {
  // simply supported beam-column, force at a: with k^2 = P/EI
  //   w(a) = (sin(k a) sin(k b)/(k sin(k L)) - a b/L)/P per unit force
  const double P_cr = pi * pi * kEI / (kL * kL);
  for (const double ratio : {0.02, 0.1, 0.5, 0.9}) {
    const double P = ratio * P_cr, k = std::sqrt(P / kEI);
    for (const double u : {0.05, 0.2, 0.35, 0.5, 0.8}) {
      const double a = u * kL, b = kL - a;
      const double exact =
          (std::sin(k * a) * std::sin(k * b) / (k * std::sin(k * kL)) - a * b / kL) / P;
      const double without = a * a * b * b / (3 * kEI * kL);
      const double bound = without * thrust_amplification(P, P_cr);
      EXPECT_GT(exact, without);
      EXPECT_LE(exact, bound * (1 + 1e-9));
      if (u == 0.5) {
        EXPECT_GT(exact, bound * (1 - 0.024 * ratio));
      }
    }
  }
}

TEST(Thrust, MirroredBetweenCentresItIsTheSameAndSplitsChangeNothing) {
  const part::Shaft part{210000, 0.3, {{80, 40, 40, 0, 0}, {120, 30, 20, 0, 0}}},
      image{210000, 0.3, {{120, 20, 30, 0, 0}, {80, 40, 40, 0, 0}}},
      pieces{210000, 0.3, {{30, 40, 40, 0, 0}, {50, 40, 40, 0, 0}, {120, 30, 20, 0, 0}}};
  const Supports s{Method::between_centres, {}, 1e-5, 1e-5};
  const double P = critical_thrust_N(part, s);
  EXPECT_NEAR(critical_thrust_N(image, s) / P, 1, 1e-9);
  EXPECT_NEAR(critical_thrust_N(pieces, s) / P, 1, 1e-4);
}

TEST(Thrust, RefusesWhatTakesNoThrust) {
  EXPECT_THROW(critical_thrust_N(kWire, {Method::chuck, {}, 0, 0}), std::domain_error);
  EXPECT_THROW(thrust_amplification(2, 1), std::domain_error);
  EXPECT_THROW(thrust_amplification(1, 1), std::domain_error);
  EXPECT_THROW(thrust_amplification(-1, 1), std::domain_error);
  EXPECT_THROW(thrust_amplification(std::numeric_limits<double>::quiet_NaN(), 1),
               std::domain_error);
  EXPECT_EQ(thrust_amplification(0, 1), 1);
}

}  // namespace
}  // namespace turnwright::deflection
