#pragma once
#include <string>

#include "turnwright/planning/process_plan.hpp"

namespace turnwright::report {

/// A picture (SVG 1.1) of an operation's window: speed across and feed upwards, both in
/// logarithms; the polygon, the optimum, the limits around it and lines of equal cost,
/// each with its name, as far as the window has them.  A name stands once for all edges
/// and curves that bear it.
/// @throws std::domain_error if the operation has no window.
std::string window_drawing(const planning::OperationPlan& operation);

}  // namespace turnwright::report
