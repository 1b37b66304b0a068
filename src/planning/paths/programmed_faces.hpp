#pragma once
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>

#include "planning/clamping/made_surfaces.hpp"

/// Where programs cut the surfaces of a part beside where they are drawn.
namespace turnwright::planning {

/// Displacements [mm] along the part's axis, to the right, of the shoulders that lengths are
/// measured to, so that the lengths lie in the middles of their limits:
///
///     d_b - d_a = m                                                                  (1)
///
/// of a length from face a to face b right of it, whose limits have the middle m.  Ends
/// stand where they are drawn, because programs count from them; of shoulders that lengths
/// connect with no end the leftmost stands.  Where not all lengths of a chain can be in
/// their middles, the sum of ((d_b - d_a - m)/w)^2 is least, w the widths of their limits.
/// Empty if every length between other faces than both ends has m = 0.
/// Source: derived here.
using MovedFaces = std::map<std::string, double>;
MovedFaces faces_moved_mm(const part::Drawing& drawing);

/// Displacement of the face at an end of an element; 0 where none is displaced.
double end_moved_mm(const MovedFaces& moved, const part::Drawing& drawing,
                    const Element& element, part::End end);

/// Distance [mm] of a length from the middle of its limits where programs make it, in a chain
/// whose lengths cannot all be in their middles; none of a length between both ends, which
/// follows from how the part is set up.
double off_middle_mm(const part::Drawing& drawing, const part::Tolerance& length);

/// Distances [mm] of the radii at which programs turn elements, by their ids, from the drawn
/// ones: to the middles of the limits of their sizes, of the crests of threads and of the
/// blanks of grooves.  Elements that are not in it are turned as drawn, arcs' blanks too.
std::unordered_map<std::string_view, double> to_middles_mm(const part::Drawing& drawing);
/// The limits in whose middle programs turn an element; none of one turned as drawn.
const part::Limits* turned_to_limits(const part::Drawing& drawing,
                                     const std::string& element);
/// Distance [mm] of its radius there from the drawn one.
double to_middle_mm(const part::Drawing& drawing, const std::string& element);

}  // namespace turnwright::planning
