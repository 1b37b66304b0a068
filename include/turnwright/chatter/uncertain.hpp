#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "turnwright/chatter/system.hpp"

/// Stability limits of a cutter whose modes and force are known within bands.
namespace turnwright::chatter {

/// Relative half widths: a value x is drawn uniformly within x (1 +- band).  Frequency,
/// damping ratio and stiffness are drawn for each mode separately, the force as a whole.
struct Bands {
  double frequency = 0, damping = 0, stiffness = 0, force = 0;  ///< in [0, 1)
  int samples = 100;                                            ///< >= 1
  std::uint64_t seed = 0;
};

/// `samples` systems inside the bands.  The same seed gives the same systems everywhere,
/// and a larger number of samples begins with the same systems.
std::vector<System> drawn(const System& system, const Bands& bands);

/// First losses of stability of the systems drawn; none where all are stable up to
/// ap_max.
struct UncertainLimit {
  /// Depth below which none of them, nor the nominal system, is unstable with the force
  /// at the upper end of its band.  Limits are proportional to 1/force, so the part of
  /// the force is exact; that of the modes is the worst of those drawn.
  std::optional<double> robust_mm;
  /// Depths by which 5, 50 and 95 of 100 of the systems drawn have lost stability: order
  /// statistics, the least of rank >= p samples.
  std::optional<double> p05_mm, p50_mm, p95_mm;
};

/// @param systems  from `drawn`, the same for every speed.
UncertainLimit uncertain_limit(const System& nominal, const std::vector<System>& systems,
                               const Bands& bands, double n_rpm, double ap_max_mm);

}  // namespace turnwright::chatter
