#pragma once
#include <optional>
#include <vector>

#include "turnwright/planning/prepared_part.hpp"

namespace turnwright::planning {

/// Sets `grips_mm` and `work`.  A grip that the request leaves open is half the held
/// diameter, at least 15 mm and at most half of what is held; where surfaces could then
/// not be cut in any setup, it is the longest, of those that end 2 mm before an element,
/// that leaves fewer of them, down to 5 mm.
/// Where more than three held diameters would stand out of the jaws, it is longer, as far
/// as `longer_grip_mm` goes.
void choose_grips(PreparedPart& part);

/// Grips [mm] shorter than a setup's that end 2 mm before an element, longest first, down
/// to 5 mm.
std::vector<double> shorter_grips_mm(const PreparedPart& part, std::size_t setup);

/// The longest grip [mm] of a setup: as far as the level that the jaws hold, the nearest
/// element that the setup cuts, less the largest corner of the tools, which rolls over its
/// end, and a steady rest allow.  Nothing if that is less than 1 mm longer than its grip.
std::optional<double> longer_grip_mm(const PreparedPart& part, std::size_t setup);

}  // namespace turnwright::planning
