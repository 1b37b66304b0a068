#pragma once
#include <Eigen/Dense>

#include "turnwright/milling/checks.hpp"

namespace turnwright::milling {

/// Largest eigenvalue, and how many lie outside the unit circle.
Dominant dominant(const Eigen::MatrixXd& monodromy);

}  // namespace turnwright::milling
