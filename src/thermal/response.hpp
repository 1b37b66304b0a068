#pragma once
#include <Eigen/Core>
#include <span>
#include <string>

#include "turnwright/thermal/inputs.hpp"

/// The states of LagModel with their derivatives by the parameters that enter
/// nonlinearly.
namespace turnwright::thermal {

struct Response {
  Eigen::VectorXd x;
  Eigen::VectorXd by_ln_tau;  ///< dx/d ln tau
  Eigen::VectorXd by_p;       ///< dx/dp; of the spindle alone
};

/// h = (n/n_max)^p at every row, and dh/dp; a standing spindle makes no heat.
struct Heat {
  Eigen::VectorXd h, by_p;
};

/// @param argument names the inputs in messages, as "function: argument".
/// @throws std::domain_error if the inputs differ in length or the times do not rise.
void check(const Inputs& inputs, const std::string& argument);

Heat heat(std::span<const double> rpm, double n_max_rpm, double p);

/// x of (2), with the heat constant between rows.
Response spindle(std::span<const double> time_s, const Heat& heat, double tau_s);

/// w of (3), with the ambient temperature linear between rows.
Response ambient(const Inputs& inputs, double T0_degC, double tau_s);

/// exp(-(t - t_0)/tau).
Response decay(std::span<const double> time_s, double tau_s);

}  // namespace turnwright::thermal
