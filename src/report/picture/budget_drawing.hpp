#pragma once
#include <string>

#include "turnwright/planning/plan_request.hpp"
#include "turnwright/planning/process_plan.hpp"

namespace turnwright::report {

/// One picture (SVG 1.1, readable alone, 190 mm wide) of what takes each tolerance: a bar
/// a tolerance, its whole width 100 mm of paper, the deflection first, then the machine,
/// the clamping, drift and so on, and what is left.  Independent sources add by squares
/// and are drawn as much narrower (stack.hpp (1)); what does not fit reaches over the end
/// of the width, at most by a fifth.  "" of a plan that judges no tolerance.  Equal plans
/// give equal bytes.
/// @throws std::domain_error if a number to be drawn is not finite.
std::string budget_drawing(const planning::PreparedPart& part,
                           const planning::ProcessPlan& plan);

}  // namespace turnwright::report
