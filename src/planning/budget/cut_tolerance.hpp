#pragma once
#include <optional>
#include <string>
#include <vector>

#include "tolerance_allocation.hpp"
#include "turnwright/planning/plan_request.hpp"
#include "turnwright/planning/prepared_part.hpp"
#include "turnwright/tolerance/acceptance.hpp"

/// Constraints of the drawing's tolerances on the error e of one surface.
namespace turnwright::planning {

/// The constraint of one tolerance, by its shape:
///
///     size          lower <= factor e <= upper at every position
///     centred       factor (max e - min e)/2 <= upper: a size with an offset of its tool
///     range         factor (max e - min e) <= upper
///     straightness  width of the minimum zone <= upper
///     none          the cut has no part in it
struct CutTolerance {
  enum class Shape { size, centred, range, straightness, none };
  std::size_t tolerance = 0;  ///< index into drawing.tolerances
  Shape shape = Shape::none;
  double factor = 1;
  double lower = 0, upper = 0;
  double middle_mm = 0;  ///< programmed deviation of a size: the middle of its limits
  double taken_mm = 0;   ///< share of the width that all other sources take
  /// Of a centred size whose offset follows the wear of the edge: weight of the largest
  /// error, by which the offset lags, factor u/2 with u the share of the edge's use
  /// between two corrections.  The middle of the error moves by less than its largest.
  double lag = 0;
  /// Of a size with a corrected path: what factor |e| may still reach on that path.
  double remainder = 0;
};

/// Displacement of the tool from the programmed middle of a size: none, one number for
/// the whole surface, or a correction that varies along it.  With an offset a size
/// constrains only the range of its error.  The constant offset is the machinist's wear
/// offset at that size, set once the first part is measured: it costs nothing, and every
/// pass over the surface is moved by it, so no depth of cut changes.
enum class Offset { none, constant, path };

/// The offset that a plan may use at no cost: a constant one if the first part is gauged,
/// else none.
Offset free_offset(const PreparedPart& plan);

/// The constraints of the tolerances on an outer element or a face ("left", "right",
/// "d1|d2"), where m is the share of their width t that the other sources take
/// (tolerance_allocation.hpp):
///
///     diameter      |2 e| <= (t - m)/2 about the programmed middle of the limits
///     profile       |e| cos(alpha) <= (t - m)/2
///     length        |g| <= (t - m)/4 for each of its faces if both are cut, else half
///     others        as tolerance::verdict's (4) to (8)
///
/// A width that is used up gives upper = 0, which no cut can keep.
std::vector<CutTolerance> cut_tolerances(const PreparedPart& plan,
                                         const std::string& surface, Offset offset,
                                         const Making& making);

/// The first constraint whose tolerance the other sources have used up, or null.
const CutTolerance* used_up(const std::vector<CutTolerance>& cut_tolerances);

}  // namespace turnwright::planning
