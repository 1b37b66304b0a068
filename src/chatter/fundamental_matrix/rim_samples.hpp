#pragma once
#include <complex>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

/// Taylor polynomials from samples on the rim of a disc.
namespace turnwright::chatter {

/// e^(2 pi i k/n), k = 0 .. n - 1.
std::vector<std::complex<double>> unit_roots(std::size_t n);

inline constexpr double kRounding = 1e-13;  ///< of a sample, relative to the largest

/// What of a Taylor polynomial is above the rounding of its samples.
struct Resolved {
  std::size_t terms = 0;
  double noise = 0;  ///< bound of the errors in the disc
};

/// @param size  moduli of the coefficients on the rim, one for each sample.
/// @return none if the polynomial has not decayed, or is not finite.
std::optional<Resolved> resolved(std::span<const double> size);

}  // namespace turnwright::chatter
