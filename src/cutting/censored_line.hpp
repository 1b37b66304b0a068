#pragma once
#include <Eigen/Core>
#include <vector>

#include "regression.hpp"

namespace turnwright::cutting {

/// How errors of ln T are distributed: `normal`, so that T is lognormal, or as the
/// logarithm of an exponential life, so that T is Weibull's with the shape 1/s.
enum class LifeErrors { normal, weibull };

/// A line through values of which some are only known to be longer, by maximum likelihood.
struct CensoredLine {
  Line line;            ///< s and covariance widened for the r - p degrees of freedom
  double s_likely = 0;  ///< the most likely s
  double ln_likelihood = 0;  ///< but for a number that X and y alone determine
  /// Covariance of c and ln s, widened as that of the line.
  Eigen::MatrixXd joint;
};

/// Maximises, for z_i = (y_i - x_i c)/s,
///
///     sum over known y of ln(f(z)/s) + sum over the others of ln S(z)                (1)
///     normal:  f = exp(-z^2/2)/sqrt(2 pi), S = 1 - Phi(z)
///     weibull: f = exp(z - e^z),           S = exp(-e^z)
///
/// by Newton's method in c/s and 1/s, in which (1) is concave.  The covariance is the
/// inverse of the observed information, times r/(r - p) for r known values and p
/// coefficients: without censoring that is least squares with all its intervals.
/// Where the known values lie on one line, s ends at 1e-9, not at 0.
/// Source: [Tobin 1958], concavity [Olsen 1978]; the widening is derived here; life_fit_test
/// compares with another program and counts how often intervals hold the truth.
/// @param longer  whether y_i is a lower bound; the rows of the known values determine c
///   and are more than p.
/// @throws ModelRangeError if they do not.
CensoredLine censored_line(const Eigen::MatrixXd& X, const Eigen::VectorXd& y,
                           const std::vector<bool>& longer, LifeErrors errors);

}  // namespace turnwright::cutting
