#pragma once
#include <vector>

#include "turnwright/planning/prepared_part.hpp"
#include "turnwright/planning/process_plan.hpp"

/// Trade-off of cost and time.
namespace turnwright::planning {

/// Corners of the convex hull of cost and time, at most `plan.pareto` of them, cheapest
/// first.  Each is a plan of its own, which conforms if the request is robust.
/// @param own  the plan for the request's own objective, which is not solved again.
std::vector<ParetoPoint> pareto(const PreparedPart& plan, const ProcessPlan& own);

}  // namespace turnwright::planning
