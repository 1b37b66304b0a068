#pragma once
#include <string>

#include "turnwright/planning/plan_request.hpp"
#include "turnwright/planning/prepared_part.hpp"
#include "turnwright/planning/process_plan.hpp"

namespace turnwright::report {

/// One self-contained picture (SVG 1.1, 190 mm wide) of the shares of each tolerance.
/// Each tolerance is a bar, whose width is 100 mm of paper: first the deflection, then
/// machine, clamping, drift and so on, and the rest.  Independent sources add by squares
/// and are drawn correspondingly narrower (stack.hpp (1)); shares that exceed the width
/// extend beyond the bar, at most by a fifth.  The picture is "" for a plan without
/// tolerances. Equal plans give equal bytes.
/// @throws std::domain_error if a number to be drawn is not finite.
std::string budget_drawing(const planning::PreparedPart& part,
                           const planning::ProcessPlan& plan);

}  // namespace turnwright::report
