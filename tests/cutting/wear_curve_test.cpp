#include "turnwright/cutting/wear_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace turnwright::cutting {
namespace {

TEST(WearCurve, LifeIsWhereTheCurveReachesTheCriterion) {
  const std::vector<WearPoint> curve{{5, 0.1}, {10, 0.14}, {20, 0.24}, {30, 0.4}};
  const auto life = life_of_curve(curve, 0.3);
  EXPECT_NEAR(life.T_min, 20 + 10 * 0.06 / 0.16, 1e-12);
  EXPECT_FALSE(life.longer);
  EXPECT_EQ(life_of_curve(curve, 0.24).T_min, 20);            // at a point
  EXPECT_NEAR(life_of_curve(curve, 0.05).T_min, 2.5, 1e-12);  // from the new edge on
}

TEST(WearCurve, IsNotContinuedBeyondItsEnd) {
  const std::vector<WearPoint> curve{{5, 0.1}, {10, 0.299}};
  EXPECT_EQ(life_of_curve(curve, 0.3).T_min, 10);
  EXPECT_TRUE(life_of_curve(curve, 0.3).longer);
  EXPECT_FALSE(life_of_curve(curve, 0.299).longer);
}

TEST(WearCurve, TheFirstCrossingCountsWhereReadingsFallBack) {
  const std::vector<WearPoint> curve{{5, 0.1}, {10, 0.35}, {15, 0.28}, {20, 0.4}};
  EXPECT_NEAR(life_of_curve(curve, 0.3).T_min, 9, 1e-12);
}

TEST(WearCurve, APointEveryTenthOfTheLifeIsNearEnough) {
  for (const double power : {1.5, 2.0, 3.0}) {
    std::vector<WearPoint> curve;
    for (double t = 0.73; t < 15; ++t)
      curve.push_back({t, 0.3 * std::pow(t / 10, power)});
    const double T = life_of_curve(curve, 0.3).T_min;
    EXPECT_LE(T, 10);
    EXPECT_GT(T, 9.9);
  }
}

TEST(WearCurve, ScalesWithTimeAndWithWear) {
  std::vector<WearPoint> curve{{5, 0.1}, {10, 0.14}, {30, 0.4}};
  const double T = life_of_curve(curve, 0.3).T_min;
  for (auto& p : curve) p.t_min *= 60, p.VB_mm *= 1000;
  EXPECT_NEAR(life_of_curve(curve, 300).T_min, 60 * T, 1e-9);
}

TEST(WearCurve, RefusesWhatIsNoCurve) {
  const auto refused = [](const std::vector<WearPoint>& curve, double criterion) {
    EXPECT_THROW(life_of_curve(curve, criterion), std::domain_error);
  };
  refused({}, 0.3);
  refused({{0, 0.1}}, 0.3);
  refused({{5, 0.1}, {5, 0.2}}, 0.3);
  refused({{5, -0.1}}, 0.3);
  refused({{5, std::nan("")}}, 0.3);
  refused({{std::nan(""), 0.1}}, 0.3);
  refused({{5, 0.1}}, 0);
  refused({{5, 0.1}}, std::nan(""));
}

}  // namespace
}  // namespace turnwright::cutting
