#pragma once
#include <vector>

#include "turnwright/planning/prepared_part.hpp"
#include "turnwright/planning/process_plan.hpp"

/// Conflicts that no condition of turning and boring decides.
namespace turnwright::planning {

/// Adds a conflict for every surface that no setup can cut.
void add_unreachable(const PreparedPart& part, ProcessPlan& result);

/// Adds a conflict for each of the given tolerances that the machine's share alone uses
/// up.
void add_used_up(const PreparedPart& plan, const std::vector<std::size_t>& tolerances,
                 ProcessPlan& result);

/// Tolerances of surfaces that no setup cuts: no condition and no other limit can help
/// them.
std::vector<std::size_t> tolerances_left_to_the_stock(const PreparedPart& part);

/// Adds the conflicts of operations at fixed conditions that no clamping of their setup
/// resolves.
void add_auxiliary_conflicts(const PreparedPart& part, ProcessPlan& result);

}  // namespace turnwright::planning
