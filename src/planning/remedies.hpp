#pragma once
#include "planning/setup/clamping_comparison.hpp"

namespace turnwright::planning {

/// Adds to the result of an infeasible part the changes of the request, other than of its
/// limits, that make it feasible.  Each is planned before it is added.  A change allows a
/// clamping that the machine has and the request leaves out (a steady rest at the middle
/// of an element that the setup does not cut); lets the jaws hold as much as the nearest
/// element that the setup cuts allows, or end before an element that no setup can cut; allows a tool of
/// the catalogue that the request leaves out; or leaves a given condition to the planner.
/// Where no limit can be relaxed alone and none of these changes helps alone, pairs of
/// them are tried.  Remedies are sorted by cost; changes that do not help alone are in
/// `tried`.
/// @param attempt  the setups as they were solved; null if none was solved
void add_remedies(const PreparedPart& part, const Attempt* attempt, ProcessPlan& result);

}  // namespace turnwright::planning
