#pragma once
#include <cmath>

namespace turnwright::chatter {

/// x less whole periods, in [0, period).
inline double remainder_of(double x, double period) {
  return x - period * std::floor(x / period);
}

}  // namespace turnwright::chatter
