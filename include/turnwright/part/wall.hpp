#pragma once
#include "turnwright/part/drawing.hpp"

namespace turnwright::part {

/// The wall between outside and bore at a place of the finished part.
struct Wall {
  double z_mm = 0;
  double share = 1;  ///< of the outer radius there; not positive where there is no wall
};

/// Where the finished part's wall is thinnest for its radius: at an end of an element, on
/// one of its sides, for in between both radii are straight.  Cuts count with their cores.
/// @param drawing  its lengths and outer diameters positive.
Wall thinnest_wall(const Drawing& drawing);

}  // namespace turnwright::part
