#pragma once

namespace turnwright::planning {

/// The limits against which the conditions of an operation are checked; limit_table.hpp
/// has a row for each.
enum class Check {
  depth_min,
  depth_max,
  feed_min,
  feed_max,
  vc_min,
  vc_max,
  tolerance,
  Ra,
  Rz,
  power,
  torque,
  feed_force,
  grip,
  spindle_max,
  spindle_min,
  force,
  life_min,
  life_max,
  chatter,
  chip_min,
  chip_max,
  speed_window,
  stable_depth,  ///< of milled places, as are the next
  part_compliance,
  milled_depth_max,
  chip_thickness_max,
  chip_thickness_min,
  milled_vc_max,
  milled_n_max,
  milled_feed_max
};

/// Whether a check's value may have either sign, or vanish.
inline bool either_sign(Check c) { return c == Check::tolerance || c == Check::chatter; }

}  // namespace turnwright::planning
