#pragma once
#include "turnwright/planning/process_plan.hpp"

/// The certified plan alone, without what `plan` may be asked for besides it.
namespace turnwright::planning {

/// Whether a plan that cannot be made says why.
enum class Why { told, untold };

/// Every tolerance is kept nominally; of a robust plan by (1) of allowance.hpp, and by
/// (2) where `other_ends` says so.  Of changed requests only what they save to first
/// order.
ProcessPlan planned(const PreparedPart& plan, const std::vector<WhatIf>& what_if = {},
                    Why why = Why::told);

/// As `planned`; of a robust plan every tolerance has the probability `conformance`.
/// Sizes that fail at their other limit too are asked for what that takes, (2) of
/// allowance.hpp, with the share b they have; past some rounds as if their errors had
/// both signs, which suffices whatever they are.
ProcessPlan conforming(PreparedPart plan, const std::vector<WhatIf>& what_if = {},
                       Why why = Why::told);

}  // namespace turnwright::planning
