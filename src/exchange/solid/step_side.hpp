#pragma once
#include <optional>
#include <vector>

#include "step_axis.hpp"

namespace turnwright::exchange {

/// A face about the axis, or several that are one surface, as a side of the half profile
/// with the material on the right hand.
struct TurnedSide {
  enum class Kind { plane, cylinder, cone, round };
  Kind kind = Kind::plane;
  Point from, to;
  Point centre;          ///< of the arc that a torus or sphere is
  double radius_mm = 0;  ///< of that arc
  bool convex = true;    ///< the arc bulges out of the material: it turns right
  double turn_rad = 0;   ///< of the arc from end to end, (0, 2 pi)
  double round_rad = 0;  ///< how much of the full circle is there, mean along the side
  std::vector<std::size_t> faces;
  /// Whether the normal out of the material points away from the axis.
  bool outside() const;
  double largest_mm() const { return std::max(from.r_mm, to.r_mm); }
};

/// The side that a face is, between its outermost circles about the axis, or from a circle
/// to the axis where the face reaches that.  Nothing if it is no surface about the axis, or
/// has no two such circles.
///
/// With n the normal out of the material in the plane (z, r), the way along the side with
/// the material on the right is (n_r, -n_z); an arc of the boundary that turns left about
/// the axis has the face on that side if the face's normal points out (1).
/// Source: (1) derived here from the rule that a face lies on the left of its boundary.
std::optional<TurnedSide> side_of(const Face& face, std::size_t index, const Axis& axis);

/// Sides that cover the same surface joined to one, in the order of the first of each.
std::vector<TurnedSide> merged(std::vector<TurnedSide> sides);

}  // namespace turnwright::exchange
