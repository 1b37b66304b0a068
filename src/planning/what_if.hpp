#pragma once
#include <vector>

#include "turnwright/planning/changed_request.hpp"
#include "turnwright/planning/process_plan.hpp"
#include "turnwright/planning/rules.hpp"

namespace turnwright::planning {

/// Plans every changed request and stores what it saves against `result`, which already
/// has the first-order estimates.
void answer(const PreparedPart& plan, const std::vector<WhatIf>& what_if,
            ProcessPlan& result);

/// Plans the request without each of its rules, and stores in `result` what the rule costs.
void answer(const PreparedPart& plan, const std::vector<WithoutRule>& without,
            ProcessPlan& result);

}  // namespace turnwright::planning
