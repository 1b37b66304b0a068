#pragma once
#include <algorithm>
#include <cmath>
#include <complex>

#include "turnwright/chatter/system.hpp"

namespace turnwright::chatter {

/// One mode under a constant factor: s^2 + 2 zeta wn s + wn^2 (1 + b (1 - e^(-s tau))) =
/// 0, b = w K/k.  e^(Re s tau) of the rightmost root, by Newton's method from every fifth
/// of a radian.
inline double radius_under_constant_factor(const Mode& m, double b, double tau) {
  double most = -1e9;
  for (double turn = 0; turn < 4 * m.wn_rad_s * tau; turn += 0.2) {
    std::complex<double> s(-0.1 / tau, turn / tau);
    for (int i = 0; i < 100; ++i) {
      const std::complex<double> delayed =
          m.wn_rad_s * m.wn_rad_s * b * std::exp(-s * tau);
      const std::complex<double> f = s * s + 2 * m.zeta * m.wn_rad_s * s +
                                     m.wn_rad_s * m.wn_rad_s * (1 + b) - delayed;
      const std::complex<double> step =
          f / (2.0 * s + 2 * m.zeta * m.wn_rad_s + tau * delayed);
      s -= step;
      if (std::abs(step) < 1e-13 * std::abs(s)) {
        most = std::max(most, s.real());
        break;
      }
    }
  }
  return std::exp(most * tau);
}

}  // namespace turnwright::chatter
