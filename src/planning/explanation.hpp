#pragma once
#include "turnwright/planning/process_plan.hpp"

namespace turnwright::planning {

/// Adds to the result of a part that cannot be made why it cannot: limits that conflict,
/// how far each would have to open, and what else would make it feasible.  Nothing where
/// the plan is feasible.
void add_explanation(const PreparedPart& part, ProcessPlan& result);

}  // namespace turnwright::planning
