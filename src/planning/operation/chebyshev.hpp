#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <vector>

#include "chain.hpp"

/// Polynomials through values at Chebyshev points.
namespace turnwright::planning {

/// Chebyshev nodes cos((2 k + 1) pi/2 n) for interpolation of degree n - 1 on [-1, 1].
std::vector<double> chebyshev(std::size_t n);

/// Monomial coefficients of the polynomials through columns of values at the points.
Eigen::MatrixXd through(const std::vector<double>& points, const Eigen::MatrixXd& values);

/// Monomial coefficients, one column each, of polynomials that approximate several
/// functions on [-1, 1], through 11 points, or more until the last terms of the Chebyshev
/// series are below 1e-11 of its largest (25 points at most).
Eigen::MatrixXd following(const std::function<Eigen::VectorXd(double u)>& values);

/// A polynomial without trailing coefficients that are only rounding, which saves
/// operations in every box.
Polynomial polynomial(const Eigen::VectorXd& c, double centre, double half);

}  // namespace turnwright::planning
