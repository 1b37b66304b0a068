#pragma once
#include "turnwright/planning/process_plan.hpp"

/// The certified plan alone, without what `plan` may be asked for besides it.
namespace turnwright::planning {

/// Whether a plan that cannot be made says why.
enum class Why { told, untold };

/// Every tolerance is kept, of a robust plan with the probability `conformance` by
/// (1) and (2) of allowance.hpp.  Of changed requests only what they save to first order.
ProcessPlan planned(const PreparedPart& plan, const std::vector<WhatIf>& what_if = {},
                    Why why = Why::told);

}  // namespace turnwright::planning
