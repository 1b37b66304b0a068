#pragma once
#include <algorithm>

#include "section.hpp"
#include "turnwright/review/cuts.hpp"

/// A tool of the turret as it meets the part.
namespace turnwright::review {

struct MountedEdge {
  Polygon edge;   ///< in the part's directions, from the programmed point
  Polygon small;  ///< smaller by what a rapid may touch
  bool inner = false, on_axis = false, threads = false, plunges = false;
  double width_mm = 0;  ///< of a blade
  double re_mm = 0;
  /// On the axis: the radius, which the tool has `point_mm` behind its point.
  double radius_mm = 0, point_mm = 0;
  double radius_behind_mm(double mm) const {
    return point_mm > 0 ? radius_mm * std::min(1.0, mm / point_mm) : radius_mm;
  }
};

/// @param sign  of the program's z in the part's.
MountedEdge mounted_edge(const MountedTool& tool, double sign);

}  // namespace turnwright::review
