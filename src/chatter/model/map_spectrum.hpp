#pragma once
#include <Eigen/Dense>
#include <functional>

namespace turnwright::chatter {

/// Multipliers of one cut by a map from one period to the next.
struct Spectrum {
  double radius = 0;  ///< the largest modulus
  int outside = 0;    ///< number of multipliers with a modulus above 1
};

using LinearMap = std::function<Eigen::VectorXd(const Eigen::VectorXd& before)>;

/// Arnoldi's method finds the largest eigenvalue of the map and all eigenvalues outside the
/// unit circle; of a small map all eigenvalues are computed.
/// @throws ModelRangeError if several multipliers have so similar moduli that the largest
///   does not converge to 1e-6.
Spectrum spectrum_of(Eigen::Index size, const LinearMap& map);

}  // namespace turnwright::chatter
