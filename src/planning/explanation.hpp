#pragma once
#include "turnwright/planning/prepared_part.hpp"
#include "turnwright/planning/process_plan.hpp"

namespace turnwright::planning {

/// Adds an explanation to the result of a part that cannot be made: the limits that
/// conflict, how far each would have to be relaxed, and changes of the request that make
/// the part feasible.  A feasible result is not changed.
void add_explanation(const PreparedPart& part, ProcessPlan& result);

}  // namespace turnwright::planning
