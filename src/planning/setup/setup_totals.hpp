#pragma once
#include "solved_setup.hpp"

/// Time and cost of setups.
namespace turnwright::planning {

/// Time and cost per part of a setup by what they are spent on.
Breakdown breakdown(const PreparedPart& plan, const SolvedSetup& setup);
/// Cost, time and profit of a result from its breakdown.
void add_totals(const PreparedPart& plan, ProcessPlan& result);

/// Time and cost of preparing the machine for all setups.
SettingUp setting_up(const PlanRequest& plan);

}  // namespace turnwright::planning
