#pragma once
#include <Eigen/Core>

namespace turnwright {

/// Least squares with what the uncertainty of its solution needs.
struct LeastSquares {
  Eigen::Index rank = 0;
  Eigen::VectorXd x;  ///< argmin |A x - v|; columns that depend on others have 0
  /// (A^T A)^-1 = root root^T: as many rows as A has columns, as many columns as its
  /// rank. The rows of the columns left out are 0.  A root has no negative variances.
  Eigen::MatrixXd root;
};

/// By QR with column pivoting.  A column is left out if what the others leave of it is
/// less than `dependent` times the largest column; 0: rounding alone.
/// A finite, v as long as A has rows.
LeastSquares least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& v,
                           double dependent = 0);

}  // namespace turnwright
