#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "tracking.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/milling/limits.hpp"
#include "unit_circle.hpp"

namespace turnwright::milling {
namespace {

using units::kPi;

/// The largest modulus of a multiplier of the free vibration, which is that of a depth 0.
double free_radius(const System& system, double tau) {
  double slowest = std::numeric_limits<double>::infinity();
  for (const Mode& m : system.modes) {
    const double b2 = (m.zeta - 1) * (m.zeta + 1);
    const double decay =
        b2 > 0 ? 1 / (m.zeta + std::sqrt(b2)) : m.zeta;  // of the slower solution
    slowest = std::min(slowest, decay * m.wn_rad_s);
  }
  return std::exp(-slowest * tau);
}

/// The least modulus among zeros that Newton's method finds between two circles, from
/// points halfway; none if it finds none there.
std::optional<double> modulus_between(const Characteristic& f, double w, double inner,
                                      double outer) {
  constexpr int kStarts = 64;
  std::optional<double> least;
  const double middle = std::sqrt(inner * outer);
  for (int i = 0; i <= kStarts; ++i) {
    const double r = std::abs(zero_near(f, w, std::polar(middle, kPi * i / kStarts)));
    if (r > inner * (1 - 1e-9) && r < std::min(outer, least.value_or(outer)) * (1 + 1e-9))
      least = r;
  }
  return least;
}

/// The least modulus of a zero, of which there is none inside `none` and one inside
/// `some`: circles are counted until they are near to each other, and so is what lies
/// inside a zero found between them.
double least_modulus(const Characteristic& f, double w, double none, double some) {
  constexpr double kClose = 1e-9;
  double apart = 1.1;
  while (some > none * (1 + 2 * kClose)) {
    while (some > apart * none) {
      const double middle = std::sqrt(none * some);
      (multipliers_outside(f, w, middle) > 0 ? some : none) = middle;
    }
    if (const auto r = modulus_between(f, w, none, some)) {
      const double inside = *r * (1 - kClose);
      if (inside <= none || multipliers_outside(f, w, inside) == 0) return *r;
      some = inside;
    }
    apart = std::sqrt(apart);
  }
  return std::sqrt(none * some);
}

}  // namespace

Multipliers multipliers(const System& system, double n_rpm, double ap_mm) {
  const Characteristic f(system, n_rpm, kFine);
  const double free = free_radius(system, f.tau_s());
  if (ap_mm == 0) return {.unstable = 0, .spectral_radius = free};
  const int unstable = multipliers_outside(f, ap_mm);

  double none = 1, some = 1;
  if (unstable > 0) do {
      some = none;
      none /= 2;
    } while (multipliers_outside(f, ap_mm, none) > 0);
  else
    do {
      none = some;
      some *= 1.5;
    } while (multipliers_outside(f, ap_mm, some) == 0);
  return {.unstable = unstable,
          .spectral_radius = 1 / least_modulus(f, ap_mm, none, some)};
}

}  // namespace turnwright::milling
