#pragma once
#include <Eigen/Dense>

#include "turnwright/chatter/dominant.hpp"

namespace turnwright::chatter {

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix);

/// Eigenvalues with their eigenvectors as columns of length 1.
struct Eigenpairs {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;
};
Eigenpairs eigenpairs(const Eigen::MatrixXd& matrix);

/// The largest eigenvalue, and the number outside the unit circle.
Dominant dominant(const Eigen::MatrixXd& monodromy);

}  // namespace turnwright::chatter
