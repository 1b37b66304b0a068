#pragma once
#include <vector>

#include "turnwright/planning/process_plan.hpp"

namespace turnwright::planning {

/// Plans every changed request and says what it saves against `result`, which has their
/// first-order answers already.
void answer(const PreparedPart& plan, const std::vector<WhatIf>& what_if,
            ProcessPlan& result);

}  // namespace turnwright::planning
