#pragma once
#include <vector>

#include "step_axis.hpp"
#include "turnwright/exchange/outline.hpp"

namespace turnwright::exchange {

/// A milled place as its faces give it; `on` and the depth depend on the cylinder.
struct Pocket {
  Milled milled;        ///< z as in the file
  double floor_mm = 0;  ///< of the floor from the axis; <= 0: it is no place outside
  bool square_ends = false;
};

/// What connected faces are: one keyway or slot, or flats.  A plane that several faces
/// divide counts once.  Nothing if a face is left over.
std::vector<Pocket> pockets(const std::vector<const Face*>& group, const Axis& axis);

}  // namespace turnwright::exchange
