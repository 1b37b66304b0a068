#pragma once
#include <vector>

#include "turnwright/planning/changed_request.hpp"
#include "turnwright/planning/prepared_part.hpp"
#include "turnwright/planning/process_plan.hpp"

/// Plans of a part, and predictions of given ones.
namespace turnwright::planning {

/// Certified cheapest process plan of a part, and the savings of changed requests.
/// @throws std::domain_error if profit is the objective and no price is given.
ProcessPlan plan(const PreparedPart& part, const std::vector<WhatIf>& what_if = {});
ProcessPlan plan(const PlanRequest& request);

/// Deviations, margins, time and cost of a part whose operations are given completely, in
/// the first clamping of each setup.  Nothing is optimised; limits that are not kept are
/// `conflicts`, and the tolerances are judged nevertheless.
/// @throws std::domain_error if a setup has no clamping, or a turning operation no speed
///   or feed.
ProcessPlan predict(const PreparedPart& part);
ProcessPlan predict(const PlanRequest& request);

}  // namespace turnwright::planning
