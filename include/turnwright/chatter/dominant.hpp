#pragma once
#include <complex>
#include <optional>

namespace turnwright::chatter {

/// Multipliers by an approximate method.
struct Dominant {
  std::complex<double> multiplier;  ///< of largest modulus
  std::optional<int> unstable;      ///< number outside the unit circle, if it is counted
};

}  // namespace turnwright::chatter
