#pragma once
#include <optional>
#include <vector>

namespace turnwright::chatter {

/// A depth at which the cut changes between stable and unstable.
struct Crossing {
  double ap_mm = 0;
  bool loss = true;           ///< true: stable below, unstable above; false: the reverse
  bool flip = false;          ///< true: the multiplier is -1; false: a pair e^(+-i theta)
  double theta_rad = 0;       ///< argument of the multiplier, in (0, pi]
  double frequency_Hz = 0;    ///< of the chatter, (1) of limits.hpp
  double relative_error = 0;  ///< estimated, of ap_mm
};

/// Stability at one spindle speed, up to a depth.
struct SpeedLimits {
  double n_rpm = 0;
  std::vector<Crossing> crossings;  ///< rising
  std::vector<int> unstable;        ///< unstable multipliers at the requested depths
  /// Depth at which the search ended, if not at the largest: deeper ones are undecided,
  /// and `unstable` ends there.
  std::optional<double> searched_mm = {};
  /// The first loss; none if the cut is stable up to the largest depth.
  std::optional<double> limit_mm() const;
};

/// Multipliers of one cut.
struct Multipliers {
  int unstable = 0;            ///< outside the unit circle, a pair counts as two
  double spectral_radius = 0;  ///< largest modulus
  bool certified = true;       ///< whether `unstable` is the winding number
};

}  // namespace turnwright::chatter
