#include <algorithm>
#include <cmath>
#include <limits>

#include "tracking.hpp"
#include "turnwright/base/errors.hpp"
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

/// The zero of f(z, w (1 - z)) of least modulus, between two circles that part it from
/// the others as far as bisection went: Newton's method from points between them.
double least_modulus(const Characteristic& f, double w, double none, double some) {
  constexpr int kStarts = 64;
  double least = some;
  bool found = false;
  const double middle = std::sqrt(none * some);
  for (int i = 0; i <= kStarts; ++i) {
    const Complex z = zero_near(f, w, std::polar(middle, kPi * i / kStarts));
    if (!(std::abs(z) > none * (1 - 1e-9) && std::abs(z) < some * (1 + 1e-9))) continue;
    least = std::min(least, std::abs(z));
    found = true;
  }
  if (!found)
    throw ModelRangeError("milling: the dominant multiplier could not be isolated");
  return least;
}

}  // namespace

Multipliers multipliers(const System& system, double n_rpm, double ap_mm) {
  const Characteristic f(system, n_rpm, kFine);
  const double free = free_radius(system, f.tau_s());
  if (ap_mm == 0) return {.unstable = 0, .spectral_radius = free};
  const int unstable = multipliers_outside(f, ap_mm);

  // Two circles |z| near to each other, inside the one of which there is no zero.
  constexpr double kApart = 1.1;
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
  while (some > kApart * none) {
    const double middle = std::sqrt(none * some);
    (multipliers_outside(f, ap_mm, middle) > 0 ? some : none) = middle;
  }
  return {.unstable = unstable,
          .spectral_radius = 1 / least_modulus(f, ap_mm, none, some)};
}

}  // namespace turnwright::milling
