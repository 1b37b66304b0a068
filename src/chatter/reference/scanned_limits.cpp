#include <cmath>
#include <limits>
#include <numbers>

#include "chatter/model/chatter_frequency.hpp"
#include "turnwright/chatter/reference_methods.hpp"

namespace turnwright::chatter {

SpeedLimits scanned_limits(const System& system, double n_rpm, double ap_max_mm,
                           int depths,
                           const std::function<Dominant(double ap_mm)>& method) {
  constexpr double kBisected = 1e-9;
  const auto stable = [&](double w) { return std::abs(method(w).multiplier) < 1; };
  SpeedLimits out{.n_rpm = n_rpm, .crossings = {}, .unstable = {}};
  bool was_stable = true;
  double below = 0;
  for (int i = 1; i <= depths; ++i) {
    const double at = ap_max_mm * i / depths;
    if (stable(at) != was_stable) {
      double low = below, high = at;
      while (high - low > kBisected * high) {
        const double middle = (low + high) / 2;
        (stable(middle) == was_stable ? low : high) = middle;
      }
      const double theta = std::abs(std::arg(method(high).multiplier));
      constexpr double kFlip = 1e-6;
      const bool flip = theta > std::numbers::pi - kFlip;
      out.crossings.push_back(
          {.ap_mm = high,
           .loss = was_stable,
           .flip = flip,
           .theta_rad = theta,
           .frequency_Hz = chatter_frequency_Hz(system, period_s(system, n_rpm), theta),
           .relative_error = std::numeric_limits<double>::quiet_NaN()});
      was_stable = !was_stable;
    }
    below = at;
  }
  return out;
}

}  // namespace turnwright::chatter
