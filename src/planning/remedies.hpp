#pragma once
#include "attempt.hpp"

namespace turnwright::planning {

/// Single changes of the request, other than of its limits, that make an infeasible part
/// feasible; each is planned.  They are: a clamping of the machine that the request
/// leaves out (with a steady rest at the middle of an element that the setup does not
/// cut), jaws that reach to the first surface that the setup cuts, a tool of the
/// catalogue that the request leaves out, and a given condition left to the planner.
/// Cheapest first.
std::vector<Remedy> remedies(const PreparedPart& part, const Attempt& attempt);

}  // namespace turnwright::planning
