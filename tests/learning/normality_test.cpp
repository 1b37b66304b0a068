#include "turnwright/learning/normality.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/statistics/anderson_darling.hpp>
#include <vector>

#include "simulated.hpp"

namespace turnwright::learning {
namespace {

TEST(Normality, NormalSamplesFailAsOftenAsTheLevelSays) {
  Draw draw(1);
  int below = 0, least = 0;
  for (int k = 0; k < 2000; ++k) {
    std::vector<double> z(60);
    for (double& x : z) x = 3 + 2 * draw.normal();
    const double p = normality(z)->p;
    below += p < 0.05;
    least += p < 0.5;
  }
  EXPECT_NEAR(below, 100, 30);
  EXPECT_NEAR(least, 1000, 70);
}

TEST(Normality, UniformAndSkewedSamplesAreFound) {
  Draw draw(2);
  std::vector<double> flat(200), skewed(200);
  for (double& x : flat) x = draw.uniform();
  for (double& x : skewed) x = -std::log(draw.uniform());
  EXPECT_LT(normality(flat)->p, 0.01);
  EXPECT_LT(normality(skewed)->p, 1e-6);
}

// Boost integrates the distance of the distributions instead of summing logarithms.
TEST(Normality, TheStatisticIsThatOfTheIntegral) {
  Draw draw(4);
  for (const std::size_t n : {8, 25, 400}) {
    std::vector<double> z(n);
    for (double& x : z) x = draw.uniform() + draw.normal();
    std::ranges::sort(z);
    const auto m = static_cast<double>(n);
    const double A2 = boost::math::statistics::anderson_darling_normality_statistic(z);
    EXPECT_NEAR(normality(z)->A2, A2 * (1 + 0.75 / m + 2.25 / (m * m)), 1e-9);
  }
}

// A* does not see place and scale.
TEST(Normality, DoesNotSeePlaceAndScale) {
  Draw draw(3);
  std::vector<double> z(30), other(30);
  for (std::size_t i = 0; i < z.size(); ++i) {
    z[i] = draw.normal();
    other[i] = 25 + 1e-3 * z[i];
  }
  EXPECT_NEAR(normality(z)->A2, normality(other)->A2, 1e-9);
}

TEST(Normality, FewOrEqualValuesAreNotJudged) {
  EXPECT_FALSE(normality(std::vector<double>{1, 2, 3, 4, 5, 6, 7}));
  EXPECT_FALSE(normality(std::vector<double>(20, 4.0)));
}

}  // namespace
}  // namespace turnwright::learning
