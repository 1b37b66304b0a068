#pragma once
#include <Eigen/Core>

namespace turnwright {

/// Solution of a least-squares problem, with the root of its covariance.
struct LeastSquares {
  Eigen::Index rank = 0;
  Eigen::VectorXd x;  ///< argmin |A x - v|; columns that depend on others have 0
  /// (A^T A)^-1 = root root^T, with as many rows as A has columns and as many columns as
  /// its rank.  The rows of omitted columns are 0.  Variances formed from a root are
  /// never negative.
  Eigen::MatrixXd root;
};

/// Minimises |A x - v| by QR with column pivoting.
/// @param A          finite.
/// @param v          one value for each row of A.
/// @param dependent  a column is omitted if its part orthogonal to the other columns is
///                   shorter than `dependent` times the longest column; 0 allows for
///                   rounding alone.
LeastSquares least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& v,
                           double dependent = 0);

}  // namespace turnwright
