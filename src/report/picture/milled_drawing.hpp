#pragma once
#include <string>

#include "turnwright/planning/process_plan.hpp"

namespace turnwright::report {

/// A picture (SVG 1.1) of the stable depth of a milled place over the spindle speed: the
/// first loss of stability with the unstable depths shaded, the chosen pass, and the box
/// of the required margins in speed and depth, which lies below the limit.
/// @throws std::domain_error if it is not a milling operation.
std::string milled_drawing(const planning::OperationPlan& operation);

}  // namespace turnwright::report
