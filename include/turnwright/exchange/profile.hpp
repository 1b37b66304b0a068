#pragma once
#include <optional>
#include <string>
#include <vector>

#include "turnwright/exchange/outline.hpp"

/// The closed half profile of a turned part, and the elements that it is made of.
namespace turnwright::exchange {

/// A point of the half plane [mm]: z along the axis, r >= 0.
struct Point {
  double z_mm = 0, r_mm = 0;
};

/// One side of the profile: straight, or an arc of less than half a turn about a centre.
struct Side {
  Point from, to;
  std::optional<Point> centre = {};
  /// Of an arc: the way from `from` to `to` turns left about the centre, z to the right
  /// and r upwards.
  bool counterclockwise = false;
  std::vector<std::string> sources = {};  ///< what it was read from
};

/// The sides in their order around the half profile, each beginning where the one before
/// ends, the material on the right hand: up the left end, along the outside from left to
/// right, down the right end, along the bores from right to left.  The axis itself is no
/// side: a solid part begins and ends on it, the profile of a through bore is closed.
struct Profile {
  std::vector<Side> sides;
};

/// The elements, edges and ends of a half profile, with z = 0 at its left end.  Sides whose
/// ends are `join_mm` or less apart are joined, equal neighbours (a face that the file
/// divides) are one element.  A side that is shorter than its neighbours and leads from a
/// cylinder to a plane is a chamfer, an arc there a fillet; a band deeper than both
/// neighbours between walls is a groove; the sizes of DIN 509's forms, and outside those of
/// DIN 76, make an undercut.  Whether the element beside that of DIN 76 is a thread of
/// its pitch is left to who knows it.
/// A point on the axis inside a blind bore's conical bottom of a drill is left to the drill,
/// which `assumed` says.
/// @throws InputError naming the side (its sources) if the profile does not close, crosses
///         itself, reaches below the axis, or has an undercut the document cannot hold.
Outline outline_of(const Profile& profile, double join_mm = 1e-6);

}  // namespace turnwright::exchange
