#pragma once
#include <string>
#include <vector>

#include "turnwright/nc/program.hpp"

namespace turnwright::report {

/// One picture (SVG 1.1, 190 mm wide) for each program: half a section of the work above
/// the spindle's axis in the program's coordinates, what every pass takes off in the
/// colour of its tool, and the path of the tool's programmed point, feeds solid and rapids
/// dashed.  X may be stretched against Z by a round factor, which the picture tells.
///
/// What is taken off follows from the programs' moves and the corners, blades and drills
/// of their tools (removal.hpp); threads show their path alone.
/// @throws std::domain_error if the programs are not those of the plan.
std::vector<std::string> path_drawings(const planning::PreparedPart& part,
                                       const planning::ProcessPlan& plan,
                                       const nc::Programs& programs);

}  // namespace turnwright::report
