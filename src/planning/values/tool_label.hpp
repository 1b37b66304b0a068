#pragma once
#include <string>

#include "turnwright/planning/process_plan.hpp"

namespace turnwright::planning {

/// The tool of an operation as programs and schedules list it: its id, and of drills,
/// centre drills, reamers, taps and blades their size, because each size is a tool of its
/// own, and so is a drill that is driven.
std::string tool_label(const PlanRequest& request, const OperationPlan& operation);

}  // namespace turnwright::planning
