#pragma once
#include <span>
#include <vector>

#include "turnwright/chatter/cutter.hpp"
#include "turnwright/chatter/stability_limits.hpp"

namespace turnwright::chatter {

/// As their namesakes of limits.hpp, by the multipliers of the delayed motion collocated
/// at depths (delay_map.hpp), between which their characteristic function is interpolated
/// until its tail is below 1e-9 of it, with a helix 1e-6, and counts as noise
/// (characteristic_interpolant.hpp).  What is searched for crossings is that function, so
/// that islands are not missed.
///
/// With teeth that differ a multiplier may be 1: `fold`.  Turning, with indentation or
/// without, is told in closed form, see turning.hpp.
/// @throws ModelRangeError as its namesake, and if a period needs too many nodes.
SpeedLimits speed_limits(const Cutter& cutter, double n_rpm, double ap_max_mm,
                         std::span<const double> depths_mm = {});

/// `unstable` is what collocation counts, with two finenesses of nodes alike; `certified`
/// says that no multiplier is nearer the circle than ten times what their spectral radii
/// differ by.
/// @throws ModelRangeError if the two do not agree, or if a period needs too many nodes.
Multipliers multipliers(const Cutter& cutter, double n_rpm, double ap_mm);

/// The wall that a stable cut leaves: the motion of the tool that the feed forces, where
/// the teeth pass the wall,
///
///     left = min over teeth of -+q_y - offset_j                                      (4)
///
/// - where they enter (up-milling, phi = 0), + where they leave (down-milling, phi = pi).
struct Surface {
  bool up_milled = false;
  std::vector<double> height_mm;  ///< over the tip, from 0 to the depth
  std::vector<double> left_mm;    ///< material left on the wall; negative: cut too deep
};

/// The walls of a cut: two of a slot.  Means nothing of a cut that is not stable.
std::vector<Surface> surfaces(const Cutter& cutter, double n_rpm, double ap_mm);

}  // namespace turnwright::chatter
