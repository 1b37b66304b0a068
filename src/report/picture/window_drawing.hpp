#pragma once
#include <string>

#include "turnwright/planning/process_plan.hpp"

namespace turnwright::report {

/// A picture (SVG 1.1) of an operation's window, with logarithmic scales of speed and
/// feed: the polygon, the optimum, the limits around it and lines of equal cost, if the
/// window has them.  Each name appears once for all edges and curves to which it belongs.
/// @throws std::domain_error if the operation has no window.
std::string window_drawing(const planning::OperationPlan& operation);

}  // namespace turnwright::report
