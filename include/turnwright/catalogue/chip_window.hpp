#pragma once
#include <vector>

#include "turnwright/catalogue/tool.hpp"

/// Chip breaker windows that are polygons.
namespace turnwright::catalogue {

/// A vertex of the window; both coordinates are > 0.
struct ChipPoint {
  double ap_mm = 0, f_mm_rev = 0;
};

/// Whether a polygon with straight edges in logarithms has an area and does not intersect
/// itself.
bool is_simple(const std::vector<ChipPoint>& polygon);

/// Divides a simple polygon, of either orientation, into convex pieces.  At its first
/// reflex vertex the polygon is cut along the diagonal that leaves fewest reflex
/// vertices, and its parts are cut in the same way: at most two cuts for each reflex
/// vertex. Vertical edges become the ends of `ap_mm`.
/// Source: derived here; chip_window_test compares with the winding number.
std::vector<ChipPiece> convex_pieces(const std::vector<ChipPoint>& polygon);

/// Whether a piece contains a point, up to rounding.
bool holds(const ChipPiece& piece, const ChipPoint& point);

}  // namespace turnwright::catalogue
