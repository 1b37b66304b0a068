#include "turnwright/chatter/limits.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "chatter/fundamental_matrix/root_tracking.hpp"
#include "chatter/fundamental_matrix/stability_crossings.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/chatter/cutter_limits.hpp"

namespace turnwright::chatter {
namespace {

using units::kPi;

/// A zero z inside the unit circle at a depth.
struct Inside {
  double w_mm = 0;
  Complex z;
};

/// The number of unstable multipliers, if known, from a depth up to that of the next
/// level.
struct Level {
  double from_mm = 0;
  std::optional<int> unstable;
};

/// Searches upwards in depth and keeps the number of unstable multipliers.
class Climb {
 public:
  Climb(const System& system, double n_rpm)
      : coarse_(system, n_rpm, kCoarse), fine_(system, coarse_.arcs(), n_rpm, kFine) {}

  void to(double ap_max) {
    double w = by_series(ap_max);
    if (w == 0) {
      w = first_strip(ap_max);
      search(0, w);
    }
    while (w < ap_max) {
      const double reached = count_ > 0 ? followed(w, ap_max) : w;
      if (reached > w) levels_.push_back({w, std::nullopt});
      if (reached >= ap_max) break;
      if (reached > w) {
        count_ = multipliers_outside(coarse_, reached);
        levels_.push_back({reached, count_});
      }
      const double next = std::min(ap_max, reached * (count_ > 0 ? 1.05 : 1.5));
      search(reached, next);
      w = next;
    }
  }

  const std::vector<Crossing>& crossings() const { return crossings_; }

  int unstable(double w) const {
    const auto above = std::ranges::upper_bound(levels_, w, {}, &Level::from_mm);
    const auto known = std::prev(above)->unstable;
    return known ? *known : multipliers_outside(coarse_, w);
  }

 private:
  /// Depth up to which one series is likely to be precise.
  double first_strip(double ap_max) const {
    constexpr double kGrowth = 5;
    double w = ap_max;
    while (coarse_.growth(2.6 * w) > kGrowth) w /= 2;
    return w;
  }

  /// Searches as far as one series is precise, and returns that depth; 0 if its noise
  /// hides the zeros, which smaller patches may tell apart.
  double by_series(double ap_max) {
    std::vector<OnCircle> zeros;
    double w = 0;
    try {
      // A series of many modes takes longer to search than it takes to follow a zero.
      constexpr std::size_t kFewModes = 2;
      constexpr double kFew = 100, kMany = 30;
      const auto whole = series_up_to(
          fine_, ap_max, fine_.system().modes.size() <= kFewModes ? kFew : kMany);
      if (!whole) return 0;
      w = whole->depth_mm;
      zeros = on_circle(whole->series, coarse_, fine_, w);
    } catch (const ModelRangeError&) {
      return 0;
    }
    enter(zeros);
    return w;
  }

  void search(double from, double to) { enter(on_circle(coarse_, fine_, from, to)); }

  void enter(const std::vector<OnCircle>& zeros) {
    for (const OnCircle& at : zeros) {
      const bool was_stable = count_ == 0;
      count_ += at.change;
      if (count_ < 0) throw std::domain_error("speed_limits: a zero was missed");
      levels_.push_back({at.w_mm, count_});
      if (was_stable == (count_ == 0)) continue;
      if (was_stable) entered_ = {at.w_mm * (1 + 1e-6), std::polar(1.0, -at.theta)};
      crossings_.push_back(crossing(at, was_stable, coarse_.system(), coarse_.tau_s()));
    }
  }

  /// The depth above w up to which the cut is shown to be unstable; w if that fails.
  double followed(double w, double ap_max) {
    const auto start = entered_ ? entered_ : zero_inside(w);
    entered_.reset();
    if (!start) return w;
    const Complex z = zero_near(coarse_, start->w_mm, start->z);
    if (!(std::abs(z) < 1)) return w;
    const Tracked done = unstable_until(coarse_, start->w_mm, ap_max, z);
    last_ = done.z;
    return std::max(w, done.w_mm);
  }

  /// A zero well inside the circle, as near as possible to the one followed last: two
  /// zeros that met on the real axis separate along it.
  std::optional<Inside> zero_inside(double w) const {
    constexpr double kInside = 0.98;
    std::vector<Complex> starts;
    for (const double r : {0.7, 0.9, 1.0}) starts.push_back(r * last_);
    for (const double r : {0.3, 0.6, 0.9})
      for (int i = 0; i <= 4; ++i) starts.push_back(std::polar(r, -kPi * i / 4));
    for (const Complex& start : starts) {
      const Complex z = zero_near(coarse_, w, start);
      if (std::abs(z) < kInside) return Inside{w, z};
    }
    return std::nullopt;
  }

  Characteristic coarse_, fine_;
  int count_ = 0;
  std::optional<Inside> entered_;  // the zero of the last loss
  Complex last_ = 0.5;             // last position of the zero followed
  std::vector<Crossing> crossings_;
  std::vector<Level> levels_{{0, 0}};
};

}  // namespace

SpeedLimits speed_limits(const System& system, double n_rpm, double ap_max_mm,
                         std::span<const double> depths_mm) {
  if (std::holds_alternative<ConstantForce>(system.force))
    return speed_limits(Cutter{.system = system}, n_rpm, ap_max_mm, depths_mm);
  Climb climb(system, n_rpm);
  climb.to(ap_max_mm);
  SpeedLimits out{.n_rpm = n_rpm, .crossings = climb.crossings(), .unstable = {}};
  for (const double w : depths_mm) out.unstable.push_back(climb.unstable(w));
  return out;
}

}  // namespace turnwright::chatter
