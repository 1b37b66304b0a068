#pragma once
#include "turnwright/part/drawing.hpp"

namespace turnwright::part {

/// The wall between outside and bore at a place of the finished part.
struct Wall {
  double z_mm = 0;
  double share = 1;  ///< of the outer radius there; not positive where there is no wall
};

/// A groove at most so long, of the outer radius, is borne by the wall beside it, if it
/// leaves at least such a wall.  The lobes of a tube spread over 1.7 radii ((3) of
/// deflection/ring.hpp for two lobes at a wall of 0.2), of which it takes an eighth.
inline constexpr double kBorneLength = 0.2, kBorneWall = 0.1;

/// Where the finished part's wall is thinnest for its radius: at an end of an element, on
/// one of its sides, for in between both radii are straight.  Cuts count with their cores,
/// but a groove that is borne by the wall beside it counts as if it were not there.
/// @param drawing  its lengths and outer diameters positive.
Wall thinnest_wall(const Drawing& drawing);

}  // namespace turnwright::part
