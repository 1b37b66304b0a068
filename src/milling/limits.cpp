#include "turnwright/milling/limits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tracking.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/units.hpp"
#include "unit_circle.hpp"

namespace turnwright::milling {
namespace {

using units::kPi;

/// The chatter frequency of (1) nearest a natural frequency [Hz].
double chatter_frequency_Hz(const System& system, double tau, double theta) {
  double nearest = 0, least = std::numeric_limits<double>::infinity();
  for (const Mode& mode : system.modes) {
    const double natural = mode.wn_rad_s / (2 * kPi);
    for (const double sign : {-1.0, 1.0}) {
      const double part = sign * theta / (2 * kPi);
      const double k = std::max(std::round(natural * tau - part), part < 0 ? 1.0 : 0.0);
      const double frequency = (k + part) / tau;
      if (std::abs(frequency - natural) < least) {
        least = std::abs(frequency - natural);
        nearest = frequency;
      }
    }
  }
  return nearest;
}

/// Walks up in depth, keeping the number of unstable multipliers.
class Climb {
 public:
  Climb(const System& system, double n_rpm)
      : coarse_(system, n_rpm, kCoarse), fine_(system, n_rpm, kFine) {}

  std::vector<Crossing> to(double ap_max) {
    double w = first_strip(ap_max);
    search(0, w);
    while (w < ap_max) {
      if (count_ > 0) {
        const double reached = follow(w, ap_max);
        if (reached >= ap_max) break;
        const bool moved = reached > w * (1 + 1e-3);
        w = reached;
        if (moved) continue;
      }
      const double next = std::min(ap_max, w * (count_ > 0 ? 1.05 : 1.5));
      search(w, next);
      w = next;
    }
    return std::move(crossings_);
  }

 private:
  /// Depth up to which one series is likely to do.
  double first_strip(double ap_max) const {
    constexpr double kGrowth = 5;
    double w = ap_max;
    while (coarse_.growth(2.6 * w) > kGrowth) w /= 2;
    return w;
  }

  void search(double from, double to) {
    for (const OnCircle& at : on_circle(coarse_, fine_, from, to)) {
      const bool was_stable = count_ == 0;
      count_ += at.change;
      if (count_ < 0) throw std::domain_error("speed_limits: a zero was missed");
      if (was_stable == (count_ == 0)) continue;
      if (was_stable) {
        start_ = at.w_mm * (1 + 1e-6);
        z_ = std::polar(1.0, -at.theta);
      }
      const double tau = coarse_.tau_s();
      crossings_.push_back(
          {.ap_mm = at.w_mm,
           .loss = was_stable,
           .flip = at.flip(),
           .theta_rad = at.theta,
           .frequency_Hz = chatter_frequency_Hz(coarse_.system(), tau, at.theta),
           .relative_error = at.relative_error});
    }
  }

  /// How far above w the cut is shown to be unstable; w itself if that does not work. The
  /// count is brought up to date.
  double follow(double w, double ap_max) {
    Complex z = zero_near(coarse_, start_, z_);
    if (!(std::abs(z) < 1) || start_ > w) return w;
    const Tracked done = unstable_until(coarse_, start_, ap_max, z);
    if (!(done.w_mm > w)) return w;
    if (done.w_mm < ap_max) count_ = multipliers_outside(coarse_, done.w_mm);
    return done.w_mm;
  }

  Characteristic coarse_, fine_;
  int count_ = 0;
  double start_ = 0;  // where z_ enters the circle
  Complex z_;
  std::vector<Crossing> crossings_;
};

}  // namespace

std::optional<double> SpeedLimits::limit_mm() const {
  if (crossings.empty()) return std::nullopt;
  return crossings.front().ap_mm;
}

SpeedLimits speed_limits(const System& system, double n_rpm, double ap_max_mm) {
  return {.n_rpm = n_rpm, .crossings = Climb(system, n_rpm).to(ap_max_mm)};
}

}  // namespace turnwright::milling
