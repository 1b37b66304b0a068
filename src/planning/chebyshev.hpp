#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <vector>

#include "chain.hpp"

/// Polynomials through values at Chebyshev points.
namespace turnwright::planning {

/// Nodes cos((2 k + 1) pi/2 n) of degree n - 1 interpolation on [-1, 1].
std::vector<double> chebyshev(std::size_t n);

/// Monomial coefficients of the polynomials through columns of values at the points.
Eigen::MatrixXd through(const std::vector<double>& points, const Eigen::MatrixXd& values);

/// Monomial coefficients, a column each, of polynomials that follow some functions on
/// [-1, 1]: 11 points, and more until the series' end is below 1e-11 of its largest term
/// (25 at the most).
Eigen::MatrixXd following(const std::function<Eigen::VectorXd(double u)>& values);

/// Trailing coefficients that are rounding are dropped: fewer operations in every box.
Polynomial polynomial(const Eigen::VectorXd& c, double centre, double half);

}  // namespace turnwright::planning
