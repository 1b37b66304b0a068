#include "turnwright/thermal/lag_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "simulated.hpp"

namespace turnwright::thermal {
namespace {

TEST(LagModel, AStepOfSpeedIsAnExponential) {
  LagModel m{.lags = {{.tau_s = 1000, .K_um = 20}},
             .p = 2,
             .n_max_rpm = 4000,
             .tau_amb_s = 500,
             .T0_degC = 21};
  const auto e = drift_um(m, {{0, 700, 5000}, {2000, 0, 0}, {21, 21, 21}});
  const double warm = 20 * 0.25 * (1 - std::exp(-0.7));
  EXPECT_NEAR(e[0], 0, 1e-12);
  EXPECT_NEAR(e[1], warm, 1e-12);
  EXPECT_NEAR(e[2], warm * std::exp(-4.3), 1e-12);
}

// w' = (s t - w)/tau from w = 0: w = s (t - tau + tau exp(-t/tau)).
TEST(LagModel, ARampOfTheAmbientLagsBehind) {
  LagModel m{.n_max_rpm = 1, .tau_amb_s = 800, .b_um_K = 5, .c_um = 2, .T0_degC = 20};
  const auto e = drift_um(m, {{0, 3600}, {0, 0}, {20, 23}});
  EXPECT_NEAR(e[1], 2 + 5 * 3.0 / 3600 * (3600 - 800 + 800 * std::exp(-4.5)), 1e-12);
}

TEST(LagModel, ASoakedMachineStandsStillAndAnUnsoakedOneSettles) {
  LagModel m{.n_max_rpm = 1, .tau_amb_s = 800, .b_um_K = 5, .c_um = 2, .T0_degC = 20};
  const Inputs still{{0, 1600}, {0, 0}, {23, 23}};
  EXPECT_NEAR(drift_um(m, still)[1], 17, 1e-12);
  m.a_um = 4;
  EXPECT_NEAR(drift_um(m, still)[0], 21, 1e-12);
  EXPECT_NEAR(drift_um(m, still)[1], 17 + 4 * std::exp(-2.0), 1e-12);
}

// Runge-Kutta on (2) and (3) in steps of 2 s, between rows of 120 s.
TEST(LagModel, AgreesWithNumericalIntegration) {
  const LagModel m = two_lags();
  const Inputs in = two_shifts();
  const auto e = drift_um(m, in);
  double x[2] = {0, 0}, w = in.ambient_degC[0] - m.T0_degC;
  const auto step = [](double y, double tau, double f0, double f1, double f2, double h) {
    const double k1 = (f0 - y) / tau, k2 = (f1 - y - h / 2 * k1) / tau,
                 k3 = (f1 - y - h / 2 * k2) / tau, k4 = (f2 - y - h * k3) / tau;
    return y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  };
  for (std::size_t i = 0; i + 1 < in.time_s.size(); ++i) {
    const double heat = in.rpm[i] > 0 ? std::pow(in.rpm[i] / m.n_max_rpm, m.p) : 0;
    for (int s = 0; s < 60; ++s) {
      const auto T = [&](double part) {
        return in.ambient_degC[i] +
               (in.ambient_degC[i + 1] - in.ambient_degC[i]) * part / 60 - m.T0_degC;
      };
      for (int j = 0; j < 2; ++j)
        x[j] = step(x[j], m.lags[static_cast<std::size_t>(j)].tau_s, heat, heat, heat, 2);
      w = step(w, m.tau_amb_s, T(s), T(s + 0.5), T(s + 1), 2);
    }
    const double past = m.a_um * std::exp(-in.time_s[i + 1] / m.tau_amb_s);
    ASSERT_NEAR(
        e[i + 1],
        m.lags[0].K_um * x[0] + m.lags[1].K_um * x[1] + m.b_um_K * w + past + m.c_um,
        1e-8)
        << i;
  }
}

TEST(LagModel, MoreRowsChangeNothing) {
  const Inputs in = two_shifts();
  const std::vector<double> extra{-5, 30, 130, 4801, 31234.5, 57599, 1e9};
  const Inputs more = with_rows_at(in, extra);
  ASSERT_EQ(more.time_s.size(), in.time_s.size() + 5);
  const auto e = drift_um(two_lags(), in), f = drift_um(two_lags(), more);
  for (std::size_t i = 0, j = 0; i < in.time_s.size(); ++i, ++j) {
    while (more.time_s[j] != in.time_s[i]) ++j;
    ASSERT_NEAR(e[i], f[j], 1e-11);
  }
}

TEST(LagModel, AShiftAfterALogGoesOnWhereItEnded) {
  const Inputs all = two_shifts();
  const auto part = [&](std::size_t from, std::size_t to) {
    const auto cut = [&](const std::vector<double>& v) {
      return std::vector<double>(v.begin() + static_cast<std::ptrdiff_t>(from),
                                 v.begin() + static_cast<std::ptrdiff_t>(to));
    };
    return Inputs{cut(all.time_s), cut(all.rpm), cut(all.ambient_degC)};
  };
  Inputs later = part(200, all.time_s.size());
  for (double& t : later.time_s) t -= 10000;  // its own clock
  const Inputs both = joined(part(0, 201), later);
  ASSERT_EQ(both.time_s.size(), all.time_s.size());
  const auto e = drift_um(two_lags(), all), f = drift_um(two_lags(), both);
  for (std::size_t i = 0; i < e.size(); ++i) ASSERT_NEAR(e[i], f[i], 1e-10);
}

TEST(LagModel, TheShiftsFirstRowTakesThePlaceOfTheLogsLast) {
  const Inputs both =
      joined({{0, 60}, {3000, 3000}, {20, 20}}, {{500, 800}, {1200, 0}, {24, 25}});
  EXPECT_EQ(both.time_s, (std::vector<double>{0, 60, 360}));
  EXPECT_EQ(both.rpm, (std::vector<double>{3000, 1200, 0}));
  EXPECT_EQ(both.ambient_degC, (std::vector<double>{20, 24, 25}));
}

TEST(LagModel, RefusesTimesThatDoNotRise) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double second : {0.0, -1.0, nan})
    EXPECT_THROW(drift_um(one_lag(), {{0, second}, {0, 0}, {20, 20}}), std::domain_error);
  EXPECT_THROW(drift_um(one_lag(), {{0, 1}, {0}, {20, 20}}), std::domain_error);
  EXPECT_THROW(drift_um(one_lag(), {}), std::domain_error);
}

}  // namespace
}  // namespace turnwright::thermal
