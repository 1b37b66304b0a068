#pragma once
#include <vector>

#include "turnwright/planning/process_plan.hpp"

/// Cost against time.
namespace turnwright::planning {

/// Corners of the convex hull, at most `plan.pareto` of them, cheapest first; each is a
/// plan of its own, which conforms where the request is robust.
/// @param own the plan for the request's own objective, which is not solved again.
std::vector<ParetoPoint> pareto(const PreparedPart& plan, const ProcessPlan& own);

}  // namespace turnwright::planning
