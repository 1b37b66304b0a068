#include "turnwright/learning/factors.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "simulated.hpp"

namespace turnwright::learning {
namespace {

constexpr double kHeld = 0.95;

TEST(Factors, OneFactorIsTheMeanWeighedByPrecision) {
  const std::vector<Prior> prior{{1, 0.2}};
  const std::vector<Evidence> evidence{{{2}, 2.6, 0.3}};
  const auto p = posterior(prior, evidence, kHeld)[0];
  const double a = 1 / 0.04, b = 4 / 0.09;
  EXPECT_NEAR(p.factor.value, (a * 1 + b * 1.3) / (a + b), 1e-12);
  EXPECT_NEAR(p.factor.u, 1 / std::sqrt(a + b), 1e-12);
  EXPECT_NEAR(p.factor.upper - p.factor.value, 1.959964 * p.factor.u, 1e-6);
  EXPECT_TRUE(p.identified);
}

// The product of prior and likelihood summed over a grid.
TEST(Factors, TwoFactorsAreThoseOfAGrid) {
  const std::vector<Prior> prior{{0.1, 0.3}, {-0.2, 0.5}};
  const std::vector<Evidence> evidence{{{1, 1}, 0.4, 0.2}, {{1, -0.5}, 0.3, 0.4}};
  double sum = 0, mean[2] = {}, square[2] = {};
  const auto ln = [](double x, double m, double s) {
    return -std::pow((x - m) / s, 2) / 2;
  };
  for (double x = -2; x <= 2; x += 0.01)
    for (double y = -3; y <= 3; y += 0.01) {
      double w = ln(x, 0.1, 0.3) + ln(y, -0.2, 0.5);
      for (const auto& e : evidence)
        w += ln(e.value, e.effects[0] * x + e.effects[1] * y, e.u);
      w = std::exp(w);
      sum += w;
      mean[0] += w * x;
      mean[1] += w * y;
      square[0] += w * x * x;
      square[1] += w * y * y;
    }
  const auto p = posterior(prior, evidence, kHeld);
  for (std::size_t i : {0, 1}) {
    const double m = mean[i] / sum;
    EXPECT_NEAR(p[i].factor.value, m, 1e-6);
    EXPECT_NEAR(p[i].factor.u, std::sqrt(square[i] / sum - m * m), 1e-6);
  }
}

TEST(Factors, WithoutEvidenceTheyStayAtTheirPrior) {
  const std::vector<Prior> prior{{0, 0.3}, {0, 0.2}};
  const std::vector<Evidence> evidence{{{1, 0}, 0.1, 0.01}};
  const auto p = posterior(prior, evidence, kHeld);
  EXPECT_TRUE(p[0].identified);
  EXPECT_FALSE(p[1].identified);
  EXPECT_DOUBLE_EQ(p[1].factor.value, 0);
  EXPECT_DOUBLE_EQ(p[1].factor.u, 0.2);
  const std::vector<Evidence> wrong{{{1}, 0.1, 0.01}};
  EXPECT_THROW(posterior(prior, wrong, kHeld), std::domain_error);
}

// Of correlated errors: z1 = t + e, z2 = e (rho near 1) tells t nearly exactly.
TEST(Factors, CorrelatedErrorsAreTakenOff) {
  const std::vector<Prior> prior{{0, 1}};
  const auto both = uncorrelated({{0}, 0.7, 1}, {{1}, 1.2, 1}, 0.999);
  const auto p = posterior(prior, both, kHeld)[0];
  EXPECT_NEAR(p.factor.value, 0.5, 0.01);
  EXPECT_NEAR(p.factor.u, std::sqrt(1 - 0.999 * 0.999), 1e-3);
}

TEST(Factors, ScatterPoolsPriorAndSample) {
  const auto prior = scatter_prior(2, 0.5);
  EXPECT_DOUBLE_EQ(prior.degrees, 2);
  const auto p = posterior(prior, 40 * 9, 40, kHeld);
  EXPECT_NEAR(p.factor.value, std::sqrt((2 * 4 + 360) / 42.0), 1e-12);
  // 97.5 and 2.5 % of chi-squared with 42 degrees of freedom: 61.777 and 25.999.
  EXPECT_NEAR(p.factor.lower, std::sqrt(368 / 61.777), 1e-3);
  EXPECT_NEAR(p.factor.upper, std::sqrt(368 / 25.999), 1e-3);
  EXPECT_TRUE(p.identified);
  EXPECT_FALSE(posterior(prior, 0.1, 0.2, kHeld).identified);
}

// Truths drawn from the prior: forces and compliance from the differences of four sizes of
// two tools, each with an unknown setting; drift and wear with correlated errors; a scatter.
TEST(Factors, IntervalsHoldTruthsOfThePriorIn93To97Percent) {
  Draw draw(12);
  constexpr int kBatches = 2000;
  int force = 0, compliance = 0, drift = 0, wear = 0, scatter = 0;
  const double by_force[4] = {0.004, 0.012, 0.003, 0.02},
               by_clamping[4] = {0.002, 0.003, 0.003, 0.004};
  const std::vector<Prior> of_means{{0, 0.25}, {0, 0.25}, {0, 1}, {0, 1}};
  const std::vector<Prior> of_slopes{{0, 2}, {1, 0.6}};
  for (int k = 0; k < kBatches; ++k) {
    const double F = 0.25 * draw.normal(), C = 0.25 * draw.normal();
    const double settings[2] = {0.02 * draw.normal(), 0.02 * draw.normal()};
    std::vector<Evidence> means;
    for (std::size_t j = 0; j < 4; ++j) {
      Evidence e{
          {by_force[j], by_clamping[j], j < 2 ? 1.0 : 0.0, j < 2 ? 0.0 : 1.0}, 0, 3e-4};
      e.value =
          F * by_force[j] + C * by_clamping[j] + settings[j / 2] + e.u * draw.normal();
      means.push_back(e);
    }
    const auto of = posterior(of_means, means, kHeld);
    force += holds(of[0].factor, F);
    compliance += holds(of[1].factor, C);
    const double d = 2 * draw.normal(), w = 1 + 0.6 * draw.normal(), rho = -0.7;
    const double one = draw.normal(),
                 other = rho * one + std::sqrt(1 - rho * rho) * draw.normal();
    const auto slopes =
        uncorrelated({{2, 0}, 2 * d + one, 1}, {{0, 3}, 3 * w + 0.5 * other, 0.5}, rho);
    const auto trend = posterior(of_slopes, slopes, kHeld);
    drift += holds(trend[0].factor, d);
    wear += holds(trend[1].factor, w);
    const double s = std::sqrt(2 * 0.16 / draw.chi_squared(2));
    scatter +=
        holds(posterior(scatter_prior(0.4, 0.5), s * s * draw.chi_squared(30), 30, kHeld)
                  .factor,
              s);
  }
  for (const int held : {force, compliance, drift, wear, scatter}) {
    EXPECT_GE(held, 0.93 * kBatches);
    EXPECT_LE(held, 0.97 * kBatches);
  }
}

}  // namespace
}  // namespace turnwright::learning
