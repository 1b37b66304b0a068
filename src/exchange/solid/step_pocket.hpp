#pragma once
#include <algorithm>
#include <limits>
#include <vector>

#include "step_axis.hpp"
#include "turnwright/exchange/outline.hpp"

namespace turnwright::exchange {

/// The numbers from the least to the largest that were added.
struct Range {
  double from = std::numeric_limits<double>::infinity(), to = -from;
  void add(double x) { from = std::min(from, x), to = std::max(to, x); }
};

/// A milled place or a cross hole as its faces give it; `on` and the depth depend on the
/// cylinder.
struct Pocket {
  Milled milled;        ///< z as in the file
  double floor_mm = 0;  ///< of the floor from the axis; <= 0: no milled place outside
  bool square_ends = false;  ///< of a cross hole, a flat bottom
};

/// The angle [deg] of a direction about the axis, from the file's z axis, its x axis if that
/// is along the part, as read_step promises.
double angle_deg(const Eigen::Vector3d& normal, const Axis& axis);

/// What connected faces are: one keyway or slot, or flats.  A plane that several faces
/// divide counts once.  Nothing if a face is left over.
std::vector<Pocket> pockets(const std::vector<const Face*>& group, const Axis& axis);

}  // namespace turnwright::exchange
