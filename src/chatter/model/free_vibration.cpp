#include "free_vibration.hpp"

#include <cmath>

namespace turnwright::chatter {

Transition transition(const Mode& mode, double t_s) {
  const double x = mode.wn_rad_s * t_s, zeta = mode.zeta;
  const double b2 = (1 - zeta) * (1 + zeta);
  double C = 0, S = 0;  // times the decay
  if (b2 > 0) {
    const double b = std::sqrt(b2), decay = std::exp(-zeta * x);
    C = decay * std::cos(b * x);
    S = decay * (b * std::abs(x) < 1e-8 ? x : std::sin(b * x) / b);
  } else {
    // Separate exponentials, for cosh would overflow where the sum is small.
    const double b = std::sqrt(-b2);
    const double slow = std::exp(-x / (zeta + b)), fast = std::exp(-(zeta + b) * x);
    C = (slow + fast) / 2;
    S = b * std::abs(x) < 1e-8 ? x * std::exp(-zeta * x)
        : b < 1                ? std::exp(-zeta * x) * std::sinh(b * x) / b
                               : (slow - fast) / (2 * b);
  }
  return {C + zeta * S, S, -S, C - zeta * S};
}

double rate(const Mode& mode) {
  const double zeta = mode.zeta;
  return mode.wn_rad_s * (zeta > 1 ? zeta + std::sqrt((zeta - 1) * (zeta + 1)) : 1);
}

}  // namespace turnwright::chatter
