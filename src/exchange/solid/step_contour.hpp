#pragma once
#include <string>
#include <vector>

#include "step_side.hpp"

namespace turnwright::exchange {

/// The half profile of a body and what it was made of.
struct Contour {
  Profile profile;                ///< z = 0 at its left end
  std::vector<TurnedSide> sides;  ///< in the same order, z as in the file
  std::vector<bool> used;         ///< faces that are part of a side
  double left_mm = 0;             ///< z of the left end in the file
};

/// The gate of turned parts: nothing lies outside the largest circle about the axis, and a
/// third of that circle is there.
/// @throws InputError with the face that is against it.
void check_turned(const std::vector<Face>& faces, const std::vector<TurnedSide>& sides,
                  const Axis& axis);

/// Chains the sides: those whose end leads nowhere are left out, again and again, then one
/// way is left.  Where sides meet, a plane gives z and a cylinder r.
/// @throws InputError naming the face where the contour does not close, divides, or
///         surrounds a hollow that no tool reaches.
Contour contour_of(const std::vector<Face>& faces, std::vector<TurnedSide> sides);

/// The profile of the faces of a body, by all of the above.
Contour step_contour(const std::vector<Face>& faces, const Axis& axis);

}  // namespace turnwright::exchange
