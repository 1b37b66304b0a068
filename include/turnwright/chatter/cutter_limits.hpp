#pragma once
#include <span>
#include <vector>

#include "turnwright/chatter/cutter.hpp"
#include "turnwright/chatter/stability_limits.hpp"

namespace turnwright::chatter {

/// Operations that the search at one speed may take: some ten seconds.
inline constexpr double kSearchWork = 2e11;

/// The limits as by the function of the same name in limits.hpp, for cutters with helix,
/// unequal pitches, runout or process damping.  The multipliers are those of the delayed
/// motion, collocated at several depths (delay_map.hpp).  Between these their
/// characteristic function is interpolated until its tail is below 1e-7 of it, in short
/// ranges 1e-5; the tail counts as noise (characteristic_interpolant.hpp).  The search for
/// crossings is made on that function, so that islands are not missed.
///
/// Edges that have a helix and none of the other options have one delay; the characteristic
/// function is then the series of propagator.hpp in 1 - z at each depth, without
/// multipliers, where that series is precise.
///
/// If the teeth differ a multiplier may be 1: `fold`.  Turning, with or without
/// indentation, is computed in closed form, see turning.hpp.
///
/// Low depths are searched first.  Where deeper ones take more than `work` operations, a
/// period of them needs too many nodes, or a multiplier stays too near the circle, the
/// crossings found so far are returned with `searched_mm`.
/// @throws ModelRangeError as that function, and if no depth at all can be decided.
SpeedLimits speed_limits(const Cutter& cutter, double n_rpm, double ap_max_mm,
                         std::span<const double> depths_mm = {},
                         double work = kSearchWork);

/// `unstable` is the count by collocation, on which two finenesses of nodes must agree;
/// `certified` is true if no multiplier is nearer to the circle than ten times the
/// difference of their spectral radii.
/// @throws ModelRangeError if the counts do not agree, or if a period needs too many
///   nodes.
Multipliers multipliers(const Cutter& cutter, double n_rpm, double ap_mm);

/// The wall that a stable cut generates, from the tool's motion forced by the feed where
/// the teeth pass the wall:
///
///     left = min over teeth of -+q_y - offset_j                                      (4)
///
/// with - where they enter (up-milling, phi = 0) and + where they leave (down-milling,
/// phi = pi).
struct Surface {
  bool up_milled = false;
  std::vector<double> height_mm;  ///< above the tip, from 0 to the depth
  std::vector<double> left_mm;    ///< remaining material; negative: cut too deep
};

/// The walls of a cut, two for a slot.  The result has no meaning for an unstable cut.
std::vector<Surface> surfaces(const Cutter& cutter, double n_rpm, double ap_mm);

}  // namespace turnwright::chatter
