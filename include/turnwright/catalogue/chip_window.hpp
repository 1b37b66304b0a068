#pragma once
#include <vector>

#include "turnwright/catalogue/tool.hpp"

/// Chip breaker windows that are polygons.
namespace turnwright::catalogue {

/// A vertex, both > 0.
struct ChipPoint {
  double ap_mm = 0, f_mm_rev = 0;
};

/// Whether a polygon, straight in logarithms, has an area and edges that meet only where
/// they follow each other.
bool is_simple(const std::vector<ChipPoint>& polygon);

/// A simple polygon as convex pieces, in either sense of turning; a convex one is its
/// own. At the first vertex that points inwards it is cut along the diagonal that leaves
/// fewest such vertices, and so are its parts: at most two cuts for each.  Vertical edges
/// are the ends of `ap_mm`.
/// Source: derived here; chip_window_test compares with the winding number.
std::vector<ChipPiece> convex_pieces(const std::vector<ChipPoint>& polygon);

/// Whether a piece holds a point, to rounding.
bool holds(const ChipPiece& piece, const ChipPoint& point);

}  // namespace turnwright::catalogue
