#pragma once
#include <optional>
#include <string>
#include <vector>

#include "turnwright/exchange/profile.hpp"

/// One side of a part from end to end, outside or inside, read as a machinist reads it:
/// bands (cylinders, cones, arcs, grooves) that meet in corners, with chamfers, fillets and
/// undercuts as attributes of the corners.  The coordinates run in the direction of the
/// chain with the material below: z and r outside from left to right; -z and -r inside from
/// right to left, for half a turn of the plane leaves every hand as it was.
namespace turnwright::exchange {

/// What the drawing does to a corner that is otherwise sharp.
struct Corner {
  enum class Kind { chamfer, fillet, undercut, rounded, recess };
  Kind kind = Kind::chamfer;
  double axial_mm = 0, angle_rad = 0;  ///< of a chamfer, from the axis
  double radius_mm = 0;                ///< of a fillet or a rounded edge
  std::string undercut = {};           ///< "E0.8x0.3", "DIN 76-A"
  double pitch_mm = 0;  ///< of the thread that an undercut of DIN 76 is for
  std::vector<std::string> sources = {};
};

struct Band {
  Shape shape = Shape::cylinder;
  Point from, to;  ///< the corners before and after it, all edges taken as sharp
  double radius_mm = 0;
  bool convex = true;
  std::vector<std::string> sources = {};
  std::vector<Corner> before = {}, after = {};  ///< at its two ends
};

struct Chain {
  std::vector<Band> bands;
  /// Sources of the walls before band i, and behind the last one: one more than bands.
  std::vector<std::vector<std::string>> walls;
};

/// @param sides  of the chain, with the faces before and behind it.
/// @throws InputError naming the side that leads back along the axis.
Chain chain_of(const std::vector<Side>& sides, double join_mm);

/// "#12, #13", or a place where the sources have no name.
std::string place(const std::vector<std::string>& sources, const Point& at);

}  // namespace turnwright::exchange
