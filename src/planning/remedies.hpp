#pragma once
#include "attempt.hpp"

namespace turnwright::planning {

/// What else than its limits would make an infeasible part feasible, one change at a
/// time, each planned: a clamping that the machine has and the request leaves out (a
/// steady rest at the middle of an element that the setup does not cut), jaws that reach
/// to what the setup cuts first, a tool of the catalogue that the request leaves out, a
/// given condition left to the planner.  Cheapest first.
std::vector<Remedy> remedies(const PreparedPart& part, const Attempt& attempt);

}  // namespace turnwright::planning
