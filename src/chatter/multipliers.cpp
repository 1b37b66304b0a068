#include <algorithm>
#include <cmath>
#include <limits>

#include "chatter/collocation/collocation.hpp"
#include "chatter/fundamental_matrix/series.hpp"
#include "chatter/fundamental_matrix/stability_crossings.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/chatter/limits.hpp"

namespace turnwright::chatter {
namespace {

constexpr double kUnsure = 1e-6;  // of a spectral radius about 1

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

}  // namespace

Multipliers multipliers(const System& system, double n_rpm, double ap_mm) {
  if (system.modes.empty()) return {.unstable = 0, .spectral_radius = 0};
  const Characteristic f(system, n_rpm, kFine);
  if (ap_mm == 0)
    return {.unstable = 0, .spectral_radius = free_radius(system, f.tau_s())};
  const Spectrum collocated = spectrum(system, n_rpm, ap_mm);
  Multipliers out{.unstable = 0, .spectral_radius = collocated.radius};
  try {
    const auto whole = series_up_to(f, ap_mm);
    const bool deep = whole && whole->depth_mm == ap_mm;
    out.unstable =
        deep ? multipliers_outside(whole->series, ap_mm) : multipliers_outside(f, ap_mm);
  } catch (const ModelRangeError&) {
    if (!(std::abs(collocated.radius - 1) > kUnsure)) throw;
    out.unstable = collocated.outside;
    out.certified = false;
  }
  return out;
}

}  // namespace turnwright::chatter
