#pragma once
#include "attempt.hpp"

namespace turnwright::planning {

/// Adds to the result of an infeasible part what else than its limits would make it
/// feasible, each planned as it says: a clamping that the machine has and the request
/// leaves out (a steady rest at the middle of an element that the setup does not cut), jaws
/// that reach to what the setup cuts first, or that end before an element no setup can cut,
/// a tool of the catalogue that the request leaves out, a given condition left to the
/// planner.  Where none of these helps alone, two of them together.  Cheapest first; what
/// was tried and does not help alone is in `tried`.
/// @param attempt  the setups as they were solved; null where the part was refused before
void add_remedies(const PreparedPart& part, const Attempt* attempt, ProcessPlan& result);

}  // namespace turnwright::planning
