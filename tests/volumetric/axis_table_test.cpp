#include "turnwright/volumetric/axis_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace turnwright::volumetric {
namespace {

const std::array<double, 5> kTrue = {1e-3, 9e-3, -2e-3, 5e-4, -1.2e-3};

AxisTable table(double noise, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<> gauss(0, noise > 0 ? noise : 1);
  AxisTable out;
  for (int i = -5; i <= 5; ++i) {
    const double t = 0.4 * i;
    out.q.push_back(100 * t);
    const double e = kTrue[0] + t * (kTrue[1] + t * (kTrue[2] + t * kTrue[3]));
    const auto read = [&](double s) {
      return e + s * kTrue[4] + (noise > 0 ? gauss(random) : 0.0);
    };
    out.plus.push_back(read(1));
    out.minus.push_back(read(-1));
  }
  return out;
}

TEST(AxisTable, PolynomialAndReversalReturn) {
  const AxisFit fit = fit_axis(table(0, 0), 100);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(fit.error.c[k], kTrue[k], 1e-15);
  EXPECT_NEAR(fit.error.b, kTrue[4], 1e-15);
  // One approach alone holds the play in c0.
  AxisTable one = table(0, 0);
  one.minus.clear();
  EXPECT_NEAR(fit_axis(one, 100).error.c[0], kTrue[0] + kTrue[4], 1e-15);
  EXPECT_EQ(fit_axis(one, 100).error.b, 0);
}

TEST(AxisTable, UncertaintyIsTheScatterOfRepeatedFits) {
  std::array<double, 5> square{}, u{};
  constexpr unsigned kRuns = 2000;
  for (unsigned run = 0; run < kRuns; ++run) {
    const AxisFit fit = fit_axis(table(1e-3, run), 100);
    for (std::size_t k = 0; k < 5; ++k) {
      const double x = k < 4 ? fit.error.c[k] : fit.error.b;
      square[k] += (x - kTrue[k]) * (x - kTrue[k]) / kRuns;
      u[k] += fit.u[k] * fit.u[k] / kRuns;
    }
  }
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(square[k] / u[k], 1, 0.15) << k;
}

TEST(AxisTable, PlacesThatAreOneToRoundingTellNothing) {
  const AxisFit fit = fit_axis({{0, 1e-300, 2e-300, 3e-300}, {1, 2, 3, 4}, {}}, 100, 1);
  for (const double u : fit.u) EXPECT_TRUE(std::isinf(u));
  EXPECT_EQ(fit.error.c[0], 0);
}

TEST(AxisTable, RefusesTooLittle) {
  EXPECT_THROW(fit_axis({{0, 1, 2}, {0, 0, 0}, {}}, 100), std::domain_error);
  EXPECT_NO_THROW(fit_axis({{0, 1, 2}, {0, 0, 0}, {}}, 100, 2));
  EXPECT_THROW(fit_axis({{0, 1, 1, 0}, {0, 0, 0, 0}, {}}, 100, 2), std::domain_error);
  EXPECT_THROW(fit_axis({{0, 1, 2, 3}, {0, 0}, {}}, 100, 1), std::domain_error);
  EXPECT_THROW(fit_axis({{0, 1, 2, 3}, {}, {}}, 100, 1), std::domain_error);
}

}  // namespace
}  // namespace turnwright::volumetric
