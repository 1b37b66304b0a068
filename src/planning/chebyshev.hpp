#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "chain.hpp"

/// Polynomials through values at Chebyshev points.
namespace turnwright::planning {

/// Nodes cos((2 k + 1) pi/2 n) of degree n - 1 interpolation on [-1, 1].
std::vector<double> chebyshev(std::size_t n);

/// Monomial coefficients of the polynomials through columns of values at the points.
Eigen::MatrixXd through(const std::vector<double>& points, const Eigen::MatrixXd& values);

/// Trailing coefficients that are rounding are dropped: fewer operations in every box.
Polynomial polynomial(const Eigen::VectorXd& c, double centre, double half);

/// Points over the finishing depth at which what depends on it is computed.
inline constexpr std::size_t kNodes = 11;

}  // namespace turnwright::planning
