#pragma once
#include "turnwright/planning/prepared_part.hpp"
#include "turnwright/planning/process_plan.hpp"

namespace turnwright::planning {

/// Adds a conflict for each given operation that no setup carries out: its surface is made
/// in another setup, by other tools, or not at all.  Fixed operations of a setup with other
/// conflicts are passed over.
void add_left_out(const PreparedPart& part, ProcessPlan& result);

}  // namespace turnwright::planning
