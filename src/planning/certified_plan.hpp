#pragma once
#include <compare>
#include <cstddef>

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

/// What a plan is chosen by; smaller is better.
double objective(const PreparedPart& part, const ProcessPlan& plan);

/// Whether a plan of a part is to be had rather than another one: it is feasible, and the
/// other is not or has a larger objective.
bool is_better(const PreparedPart& part, const ProcessPlan& plan,
               const ProcessPlan& other);

/// How far a part is from a plan, compared member by member; all zero with a plan.
struct Shortfall {
  bool unsolved = false;   ///< a conflict that no conditions can resolve
  std::size_t missed = 0;  ///< surfaces or tolerances that are not kept
  double violation =
      0;  ///< sum over these surfaces of ln(value/limit) of the worst limit
  auto operator<=>(const Shortfall&) const = default;
};

/// certified_plan() and how far from a plan the conditions are that come closest.
struct NearestPlan {
  ProcessPlan plan;
  Shortfall shortfall;
};
NearestPlan nearest_plan(const PreparedPart& part,
                         const std::vector<WhatIf>& what_if = {});

}  // namespace turnwright::planning
