#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "turnwright/chatter/system.hpp"

/// Limits of a cutter that is not known exactly.
namespace turnwright::chatter {

/// Relative half widths: a value lies within x (1 +- band), uniformly.  Frequency,
/// damping ratio and stiffness are drawn for each mode on its own, the force as a whole.
struct Bands {
  double frequency = 0, damping = 0, stiffness = 0, force = 0;  ///< in [0, 1)
  int samples = 100;                                            ///< >= 1
  std::uint64_t seed = 0;
};

/// `samples` systems inside the bands; the same seed gives the same ones everywhere, and
/// more samples begin with the same.
std::vector<System> drawn(const System& system, const Bands& bands);

/// First losses of stability of the systems drawn, none where there is none up to ap_max.
struct UncertainLimit {
  /// Depth below which none of them is unstable, nor the nominal system, with the force
  /// at the upper end of its band.  As limits go with 1/force the force's part is exact;
  /// that of the modes is the worst of those drawn.
  std::optional<double> robust_mm;
  /// So deep that 5, 50 and 95 of 100 of the systems drawn have lost stability: order
  /// statistics, the least of rank >= p samples.
  std::optional<double> p05_mm, p50_mm, p95_mm;
};

/// @param systems  of `drawn`, the same for every speed.
UncertainLimit uncertain_limit(const System& nominal, const std::vector<System>& systems,
                               const Bands& bands, double n_rpm, double ap_max_mm);

}  // namespace turnwright::chatter
