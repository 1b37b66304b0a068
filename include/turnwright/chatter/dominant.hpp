#pragma once
#include <complex>
#include <optional>

namespace turnwright::chatter {

/// What an approximate method tells of the multipliers.
struct Dominant {
  std::complex<double> multiplier;  ///< of largest modulus
  std::optional<int> unstable;  ///< multipliers outside the circle, if the method tells
};

}  // namespace turnwright::chatter
