#pragma once
#include "turnwright/planning/prepared_part.hpp"

namespace turnwright::planning {

/// Sets `grips_mm` and `work`.  A grip that the request leaves open is half the held
/// diameter, at least 15 mm and at most half of what is held; where surfaces could then
/// not be cut in any setup, it is the longest, of those that end 2 mm before an element,
/// that leaves fewer of them, down to 5 mm.
void choose_grips(PreparedPart& part);

/// Grips [mm] shorter than a setup's that end 2 mm before an element, longest first, down
/// to 5 mm.
std::vector<double> shorter_grips_mm(const PreparedPart& part, std::size_t setup);

}  // namespace turnwright::planning
