#pragma once
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
};

/// @param sign  of the program's z in the part's.
MountedEdge mounted_edge(const MountedTool& tool, double sign);

}  // namespace turnwright::review
