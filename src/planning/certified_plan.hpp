#pragma once
#include "turnwright/planning/changed_request.hpp"
#include "turnwright/planning/process_plan.hpp"

/// The plan and the proof that it is the cheapest, without explanations, `what_if` and
/// `pareto`.
namespace turnwright::planning {

/// Every tolerance is kept, of a robust plan with the probability `conformance` by
/// (1) and (2) of tolerance_allocation.hpp.  Of changed requests only what they save to first order.
/// Why a part that cannot be made cannot is for explanation.hpp.
ProcessPlan certified_plan(const PreparedPart& part,
                           const std::vector<WhatIf>& what_if = {});

}  // namespace turnwright::planning
