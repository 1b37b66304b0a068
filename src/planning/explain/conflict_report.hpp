#pragma once
#include "planning/setup/clamping_comparison.hpp"

namespace turnwright::planning {

/// Of a plan that cannot be made: its conflicting sets of limits (irreducible_conflicts.hpp) over
/// every recipe, how far each member would have to open for the others to be kept, and
/// what no limit decides.
void explain(const PreparedPart& plan, const Attempt& attempt, ProcessPlan& result);

}  // namespace turnwright::planning
