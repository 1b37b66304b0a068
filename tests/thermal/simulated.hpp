#pragma once
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "turnwright/thermal/lag_fit.hpp"

/// A spindle whose lags are known, and what a probe would read of it.
namespace turnwright::thermal {

/// Standard normal numbers, the same with every library.
class Normal {
 public:
  explicit Normal(std::uint64_t seed) : random_(seed) {}
  double operator()() {
    const double u = uniform(), v = uniform();
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
  }

 private:
  double uniform() { return (static_cast<double>(random_() >> 11) + 0.5) * 0x1.0p-53; }
  std::mt19937_64 random_;
};

/// Two shifts of steps in speed, a row each two minutes, a day's wave in the hall.
inline Inputs two_shifts(double step_s = 120) {
  const double rpm[] = {0, 3000, 0, 1500, 4500, 0, 3600, 1200, 0, 4500, 2400, 0};
  Inputs in;
  for (int i = 0; i * step_s <= 12 * 4800; ++i) {
    const double t = i * step_s;
    in.time_s.push_back(t);
    in.rpm.push_back(rpm[std::min(11, static_cast<int>(t / 4800))]);
    in.ambient_degC.push_back(22 + 1.5 * std::sin(2 * std::numbers::pi * t / 30000) +
                              0.5 * std::sin(2 * std::numbers::pi * t / 7000));
  }
  return in;
}

inline LagModel one_lag() {
  return {.lags = {{.tau_s = 2400, .K_um = 25}},
          .p = 1.4,
          .n_max_rpm = 4500,
          .tau_amb_s = 5000,
          .b_um_K = -3,
          .a_um = 4,
          .c_um = 1,
          .T0_degC = 20};
}

inline LagModel two_lags() {
  LagModel m = one_lag();
  m.lags = {{.tau_s = 600, .K_um = -8}, {.tau_s = 6000, .K_um = 30}};
  return m;
}

/// Noise of neighbouring rows correlated by rho.
inline DriftLog measured(const LagModel& model, const Inputs& inputs, double noise_um,
                         std::uint64_t seed, double rho = 0) {
  DriftLog log{inputs, drift_um(model, inputs)};
  Normal normal(seed);
  double r = noise_um * normal();
  for (double& e : log.error_um) {
    e += r;
    r = rho * r + std::sqrt(1 - rho * rho) * noise_um * normal();
  }
  return log;
}

}  // namespace turnwright::thermal
