#pragma once
#include <Eigen/Core>

namespace turnwright::optimise {

/// argmin |A x - b| over x >= 0.
///
/// Active-set method.  It ends after finitely many steps, each of which solves a
/// least-squares problem by rank-revealing QR, so dependent columns are harmless.
/// Source: [Lawson 1974], algorithm NNLS.
Eigen::VectorXd non_negative_least_squares(const Eigen::MatrixXd& A,
                                           const Eigen::VectorXd& b);

}  // namespace turnwright::optimise
