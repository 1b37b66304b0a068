#include "chatter_frequency.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "turnwright/base/units.hpp"

namespace turnwright::chatter {

double chatter_frequency_Hz(const System& system, double tau_s, double theta_rad) {
  double nearest = 0, least = std::numeric_limits<double>::infinity();
  for (const Mode& mode : system.modes) {
    const double natural = mode.wn_rad_s / (2 * units::kPi);
    for (const double sign : {-1.0, 1.0}) {
      const double part = sign * theta_rad / (2 * units::kPi);
      const double k = std::max(std::round(natural * tau_s - part), part < 0 ? 1.0 : 0.0);
      const double frequency = (k + part) / tau_s;
      if (std::abs(frequency - natural) < least) {
        least = std::abs(frequency - natural);
        nearest = frequency;
      }
    }
  }
  return nearest;
}

}  // namespace turnwright::chatter
