#pragma once
#include <vector>

#include "turnwright/planning/changed_request.hpp"
#include "turnwright/planning/process_plan.hpp"

namespace turnwright::planning {

/// A certified plan with its explanation, prices, answers to `what_if` and Pareto points.
ProcessPlan completed_plan(const PreparedPart& part, const std::vector<WhatIf>& what_if,
                           ProcessPlan certified);

}  // namespace turnwright::planning
