#pragma once
#include <string>

#include "turnwright/planning/process_plan.hpp"

namespace turnwright::report {

/// A picture (SVG 1.1) of how deep a milled place may be cut over the spindle's speeds:
/// the first loss of stability, beyond it shaded, the pass that was chosen and the box of
/// the margins asked for, in speed and depth, which stays below the line.
/// @throws std::domain_error if the operation mills nothing.
std::string milled_drawing(const planning::OperationPlan& operation);

}  // namespace turnwright::report
