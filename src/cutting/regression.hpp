#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "turnwright/cutting/estimate.hpp"

/// Straight lines through logarithms of measurements, y = X c + error, and intervals of
/// their coefficients.
namespace turnwright::cutting {

struct Line {
  Eigen::VectorXd c;
  Eigen::MatrixXd covariance;  ///< of c
  double s = 0;                ///< standard deviation of one error
  double degrees = 0;          ///< of freedom of s
};

/// Least squares with outliers left out as fit_kienzle says.
/// @throws ModelRangeError if the columns of X depend on each other.
Line robust_line(const Eigen::MatrixXd& X, const Eigen::VectorXd& y, double outlier_p,
                 Evidence& evidence);

/// Standard deviation of one further measurement of the same kind at the mean of n.
double prediction_s(double s, std::size_t n);

/// Quantile of Student's distribution for the two-sided interval.
double student(double confidence, double degrees);

/// Root mean square of the part of a column that the columns before it do not explain.
double spread(const Eigen::MatrixXd& before, const Eigen::VectorXd& column);

/// A value with the two ends in any order.
Estimate ends(double value, double one, double other);

/// c_j by Student's t, times a number.
Estimate interval(const Line& line, Eigen::Index j, double times, double confidence);

/// -c_i/c_j by Fieller's theorem, with the quantile t of `student`; c_j differs from 0 by
/// more than its interval.
Estimate ratio(const Line& line, Eigen::Index i, Eigen::Index j, double t);

/// exp(e).  @throws ModelRangeError if its upper end is not finite.
Estimate exponential(const Estimate& e);

}  // namespace turnwright::cutting
