#pragma once
#include <string>
#include <vector>

#include "turnwright/planning/plan_request.hpp"
#include "turnwright/planning/process_plan.hpp"

namespace turnwright::report {

/// One picture (SVG 1.1, readable alone, 190 mm wide) for each setup of the plan: the
/// part as it stands after the setup, half in section, in its stock and its clamping.
///
/// Lengths are drawn `scale` paper mm to the mm, the same along and across.  The surface
/// as made stands off the surface as drawn by
///
///     y = scale factor e        [paper mm]                                      (1)
///
/// e: error of the radius [mm] of an outer element or bore that the setup cuts, outwards
/// positive; factor: the largest of 1, 2, 5, 10, .. that keeps |y| within 6 mm in every
/// setup of the plan, so that its pictures compare.  A corrected tool path is drawn
/// alike, its correction dr in place of e.  Errors of faces are not drawn. Jaws are drawn
/// as bored to what they hold.  An element that no setup has cut yet has its id without
/// its size.  Equal plans give equal bytes. Source: derived here.
/// @throws std::domain_error if a number to be drawn is not finite, or there is no stock.
std::vector<std::string> setup_drawings(const planning::PreparedPart& part,
                                        const planning::ProcessPlan& plan);

}  // namespace turnwright::report
