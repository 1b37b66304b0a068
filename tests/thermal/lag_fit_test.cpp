#include "turnwright/thermal/lag_fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "simulated.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::thermal {
namespace {

const Parameter& of(const LagFit& fit, const std::string& name) {
  const auto found = std::ranges::find(fit.parameters, name, &Parameter::name);
  EXPECT_NE(found, fit.parameters.end()) << name;
  return *found;
}

void near(const LagFit& fit, const LagModel& known, double part) {
  ASSERT_EQ(fit.model.lags.size(), known.lags.size());
  for (std::size_t j = 0; j < known.lags.size(); ++j) {
    EXPECT_NEAR(fit.model.lags[j].tau_s / known.lags[j].tau_s, 1, part) << j;
    EXPECT_NEAR(fit.model.lags[j].K_um / known.lags[j].K_um, 1, part) << j;
  }
  EXPECT_NEAR(fit.model.p / known.p, 1, part);
  EXPECT_NEAR(fit.model.tau_amb_s / known.tau_amb_s, 1, part);
  EXPECT_NEAR(fit.model.b_um_K / known.b_um_K, 1, part);
}

DriftLog log_of(const LagModel& model, double noise_um = 0.05, std::uint64_t seed = 1,
                double rho = 0) {
  return measured(model, two_shifts(), noise_um, seed, rho);
}

LagFit fitted(const DriftLog& log, const FitOptions& options = {}) {
  return fit_lags(log, log.error_um.size(), options).fit;
}

TEST(LagFit, KnownLagsReturnWithinFivePercent) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    near(fitted(log_of(one_lag(), 0.05, seed)), one_lag(), 0.05);
    near(fitted(log_of(two_lags(), 0.05, seed)), two_lags(), 0.05);
  }
}

TEST(LagFit, WithoutNoiseEveryParameterReturns) {
  const LagFit fit = fitted(log_of(two_lags(), 0), {.lags = 2});
  near(fit, two_lags(), 1e-4);
  EXPECT_NEAR(fit.model.a_um, 4, 1e-3);
  EXPECT_NEAR(fit.model.c_um, 1, 1e-3);
  EXPECT_LT(fit.rms_um, 1e-4);
}

TEST(LagFit, ASecondLagMustEarnItsPlace) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    const auto simple = log_of(one_lag(), 0.3, seed),
               twice = log_of(two_lags(), 0.3, seed);
    const auto n = simple.error_um.size();
    const Choice one = fit_lags(simple, n), two = fit_lags(twice, n);
    EXPECT_EQ(one.fit.model.lags.size(), 1u);
    EXPECT_EQ(two.fit.model.lags.size(), 2u);
    // Blocks never seen are predicted about as well as the noise allows.
    EXPECT_NEAR(*one.one_lag_um, 0.3, 0.06);
    EXPECT_NEAR(*two.two_lags_um, 0.3, 0.06);
    EXPECT_GT(*two.one_lag_um, 0.5);
  }
}

TEST(LagFit, RowsBeyondThoseAskedForAreNotSeen) {
  auto log = log_of(one_lag());
  const auto half = log.error_um.size() / 2;
  const LagFit before = fit_lags(log, half).fit;
  for (std::size_t i = half; i < log.error_um.size(); ++i) {
    log.error_um[i] = 1e6;
    log.inputs.rpm[i] = 9000;
    log.inputs.ambient_degC[i] = -40;
  }
  const LagFit after = fit_lags(log, half).fit;
  for (std::size_t i = 0; i < before.parameters.size(); ++i)
    EXPECT_EQ(before.parameters[i].value, after.parameters[i].value);
}

// The scatter of many logs against what each fit says of itself.
void self_assessment(double rho) {
  constexpr int kLogs = 40;
  const auto known = fitted(log_of(one_lag(), 0)).parameters;
  std::vector<double> square(known.size(), 0.0);
  for (int seed = 1; seed <= kLogs; ++seed) {
    const LagFit fit = fitted(
        log_of(one_lag(), 0.2, static_cast<std::uint64_t>(seed), rho), {.lags = 1});
    for (std::size_t i = 0; i < known.size(); ++i)
      square[i] +=
          std::pow((fit.parameters[i].value - known[i].value) / fit.parameters[i].u, 2) /
          kLogs;
  }
  // chi2 of 40: 1 +- 0.22; rho is an estimate itself, and low by its own bias.
  for (std::size_t i = 0; i < known.size(); ++i) {
    EXPECT_GT(square[i], 0.4) << known[i].name;
    EXPECT_LT(square[i], 2.0) << known[i].name;
  }
}

TEST(LagFit, UncertaintiesAreTheScatterOfIndependentNoise) { self_assessment(0); }
TEST(LagFit, UncertaintiesAreTheScatterOfWanderingNoise) { self_assessment(0.8); }

TEST(LagFit, PredictionsScatterByTheirUncertainty) {
  Inputs plan = two_shifts(600);
  for (double& n : plan.rpm) n = 4500 - n;
  const auto known = drift_um(one_lag(), plan);
  const auto row = plan.time_s.size() / 2;
  double square = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const LagFit fit = fitted(log_of(one_lag(), 0.2, seed), {.lags = 1});
    const double u = drift_uncertainty_um(fit, plan)[row];
    EXPECT_GT(u, 0);
    square += std::pow((drift_um(fit.model, plan)[row] - known[row]) / u, 2) / 40;
  }
  EXPECT_GT(square, 0.4);
  EXPECT_LT(square, 2.0);
}

TEST(LagFit, ScaleAndZeroOfTheProbePassThrough) {
  auto log = log_of(one_lag(), 0.05);
  const LagFit fit = fitted(log);
  for (double& e : log.error_um) e = -2 * e + 100;
  const LagFit other = fitted(log);
  EXPECT_NEAR(other.model.lags[0].K_um, -2 * fit.model.lags[0].K_um, 1e-3);
  EXPECT_NEAR(other.model.c_um, 100 - 2 * fit.model.c_um, 1e-2);
  EXPECT_NEAR(other.rms_um, 2 * fit.rms_um, 1e-6);
}

TEST(LagFit, TheReferenceTemperatureMovesTheConstantAlone) {
  const auto log = log_of(one_lag());
  const LagFit at20 = fitted(log), at22 = fitted(log, {.T0_degC = 22});
  EXPECT_NEAR(at22.model.c_um, at20.model.c_um + 2 * at20.model.b_um_K, 1e-3);
  const auto e = drift_um(at20.model, log.inputs), f = drift_um(at22.model, log.inputs);
  for (std::size_t i = 0; i < e.size(); ++i) EXPECT_NEAR(e[i], f[i], 1e-3);
}

TEST(LagFit, SaysWhatTheLogCannotTell) {
  auto log = log_of(one_lag());
  for (double& T : log.inputs.ambient_degC) T = 22;
  log.error_um = drift_um(one_lag(), log.inputs);
  EXPECT_EQ(of(fitted(log), "b_um_K").found, Found::unknown);
  EXPECT_TRUE(of(fitted(log), "b_um_K").ill_determined);

  log = log_of(one_lag());
  for (double& n : log.inputs.rpm) n = n > 0 ? 4500 : 0;
  log.error_um = drift_um(one_lag(), log.inputs);
  const LagFit one_speed = fitted(log, {.lags = 1});
  EXPECT_EQ(of(one_speed, "p").found, Found::unknown);
  near(
      one_speed,
      [] {
        auto m = one_lag();
        m.p = 1;
        return m;
      }(),
      1e-3);

  log = log_of(one_lag(), 0);
  const LagFit slow = fitted(log, {.lags = 1, .tau_max_s = 1500});
  EXPECT_EQ(of(slow, "tau_1_s").found, Found::at_upper);
  EXPECT_EQ(of(slow, "tau_1_s").u, 0);
  EXPECT_TRUE(of(slow, "tau_1_s").ill_determined);
  EXPECT_NEAR(slow.model.lags[0].tau_s, 1500, 1e-6);
  const LagFit fast = fitted(log, {.lags = 1, .tau_min_s = 3000});
  EXPECT_EQ(of(fast, "tau_1_s").found, Found::at_lower);

  const LagFit given = fitted(log, {.lags = 1, .soaked_start = true, .p = 1.4});
  EXPECT_EQ(of(given, "p").found, Found::given);
  EXPECT_EQ(of(given, "a_um").found, Found::given);
  EXPECT_EQ(given.model.a_um, 0);
  EXPECT_FALSE(of(given, "p").ill_determined);
}

TEST(LagFit, RefusesWhatCannotBeFitted) {
  auto log = log_of(one_lag());
  EXPECT_THROW(fit_lags(log, kLeastRows - 1), ModelRangeError);
  EXPECT_THROW(fit_lags(log, log.error_um.size() + 1), std::domain_error);
  EXPECT_THROW(fit_lags(log, 100, {.tau_min_s = 1000, .tau_max_s = 900}),
               ModelRangeError);
  std::ranges::fill(log.inputs.rpm, 0);
  EXPECT_THROW(fit_lags(log, 100), ModelRangeError);
}

}  // namespace
}  // namespace turnwright::thermal
