#include "response.hpp"

#include <cmath>
#include <stdexcept>

namespace turnwright::thermal {
namespace {

using Eigen::Index;

double at(std::span<const double> v, Index i) { return v[static_cast<std::size_t>(i)]; }

}  // namespace

void check(const Inputs& inputs, const std::string& argument) {
  const auto rows = inputs.time_s.size();
  if (rows == 0 || inputs.rpm.size() != rows || inputs.ambient_degC.size() != rows)
    throw std::domain_error(argument +
                            ": time_s, rpm and ambient_degC must have as many rows, at "
                            "least one");
  for (std::size_t i = 1; i < rows; ++i)
    if (!(inputs.time_s[i] > inputs.time_s[i - 1]))
      throw std::domain_error(argument + ": time_s must rise");
}

Heat heat(std::span<const double> rpm, double n_max_rpm, double p) {
  const auto rows = static_cast<Index>(rpm.size());
  Heat out{Eigen::VectorXd::Zero(rows), Eigen::VectorXd::Zero(rows)};
  for (Index i = 0; i < rows; ++i) {
    const double r = at(rpm, i) / n_max_rpm;
    if (r == 0) continue;
    out.h[i] = std::pow(r, p);
    out.by_p[i] = out.h[i] * std::log(r);
  }
  return out;
}

// Over a step D with constant heat h, q = D/tau and E = exp(-q):
//   x+ = h + (x - h) E,  dx+/d ln tau = dx E + (x - h) q E,  dx+/dp = dh (1 - E) + dx E
Response spindle(std::span<const double> time_s, const Heat& heat, double tau_s) {
  const auto rows = static_cast<Index>(time_s.size());
  Response out{Eigen::VectorXd::Zero(rows), Eigen::VectorXd::Zero(rows),
               Eigen::VectorXd::Zero(rows)};
  for (Index i = 0; i + 1 < rows; ++i) {
    const double q = (at(time_s, i + 1) - at(time_s, i)) / tau_s, E = std::exp(-q);
    out.x[i + 1] = out.x[i] * E - heat.h[i] * std::expm1(-q);
    out.by_ln_tau[i + 1] = (out.by_ln_tau[i] + (out.x[i] - heat.h[i]) * q) * E;
    out.by_p[i + 1] = out.by_p[i] * E - heat.by_p[i] * std::expm1(-q);
  }
  return out;
}

// Over a step D on which the ambient rises at the rate m from T to T+:
//   w+ = T+ - m tau + (w - T + m tau) E
//   dw+/d ln tau = -m tau + (dw + m tau) E + (w - T + m tau) q E
Response ambient(const Inputs& inputs, double T0_degC, double tau_s) {
  const auto rows = static_cast<Index>(inputs.time_s.size());
  Response out{Eigen::VectorXd::Zero(rows), Eigen::VectorXd::Zero(rows), {}};
  out.x[0] = inputs.ambient_degC[0] - T0_degC;
  for (Index i = 0; i + 1 < rows; ++i) {
    const double D = at(inputs.time_s, i + 1) - at(inputs.time_s, i), q = D / tau_s,
                 E = std::exp(-q);
    const double T = at(inputs.ambient_degC, i) - T0_degC,
                 T_next = at(inputs.ambient_degC, i + 1) - T0_degC;
    const double m_tau = (T_next - T) / q, behind = out.x[i] - T + m_tau;
    out.x[i + 1] = T_next - m_tau + behind * E;
    out.by_ln_tau[i + 1] = m_tau * std::expm1(-q) + (out.by_ln_tau[i] + behind * q) * E;
  }
  return out;
}

Response decay(std::span<const double> time_s, double tau_s) {
  const auto rows = static_cast<Index>(time_s.size());
  Response out{Eigen::VectorXd(rows), Eigen::VectorXd(rows), {}};
  for (Index i = 0; i < rows; ++i) {
    const double q = (at(time_s, i) - time_s.front()) / tau_s;
    out.x[i] = std::exp(-q);
    out.by_ln_tau[i] = q * out.x[i];
  }
  return out;
}

}  // namespace turnwright::thermal
