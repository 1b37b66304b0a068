#pragma once
#include <optional>
#include <string>
#include <vector>

#include "allowance.hpp"
#include "turnwright/planning/plan_request.hpp"
#include "turnwright/tolerance/acceptance.hpp"

/// What the drawing's tolerances ask of the error e of one surface.
namespace turnwright::planning {

/// size:  lower <= factor e <= upper at every place;  centred: factor (max e - min e)/2 <=
/// upper, a size whose tool may have an offset;  range: factor (max e - min e) <= upper;
/// straightness: width of the minimum zone <= upper;  none: no term of the cut.
struct Demand {
  enum class Shape { size, centred, range, straightness, none };
  std::size_t tolerance = 0;  ///< index into drawing.tolerances
  Shape shape = Shape::none;
  double factor = 1;
  double lower = 0, upper = 0;
  double middle_mm = 0;  ///< programmed deviation of a size: the middle of its limits
  double taken_mm = 0;   ///< of the width, by all but the cut
};

/// What moves the tool of a surface off the drawn place: nothing, one number for all of
/// the surface, or a correction from place to place.  With either of these a size asks
/// only for the range of its error.  The constant offset is the machinist's wear offset at
/// that size, set once the first part is measured: it costs nothing, and every pass of the
/// surface is moved by it, so that no depth of cut changes.
enum class Offset { none, constant, path };

/// The offset that a plan may use freely: a constant one if the first part is gauged.
Offset free_offset(const PreparedPart& plan);

/// The tolerances that bear on an outer element or on a face ("left", "right", "d1|d2"),
/// after m, what all else takes (allowance.hpp), is off their width:
///
///     diameter      |2 e| <= (t - m)/2 about the programmed middle of the limits
///     profile       |e| cos(alpha) <= (t - m)/2
///     length        |g| <= (t - m)/4 for each of its faces if both are cut, else half
///     others        as tolerance::verdict's (4) to (8)
///
/// A width that is used up gives upper = 0, which nothing can keep.
std::vector<Demand> demands(const PreparedPart& plan, const std::string& surface,
                            Offset offset, const Making& making);

/// The first of some demands that what is no matter of the cut has used up, or nothing.
const Demand* used_up(const std::vector<Demand>& demands);

/// Half angle [rad] of an element, 0 of a cylinder; nothing for a face.
std::optional<double> half_angle_rad(const part::Drawing& drawing,
                                     const std::string& surface);

/// True if an operation of this plan makes the face (its end has stock, or it is a
/// shoulder).
bool face_is_cut(const PreparedPart& plan, const std::string& face);

}  // namespace turnwright::planning
