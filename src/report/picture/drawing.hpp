#pragma once
#include <string>
#include <vector>

#include "turnwright/planning/plan_request.hpp"
#include "turnwright/planning/prepared_part.hpp"
#include "turnwright/planning/process_plan.hpp"

namespace turnwright::report {

/// One self-contained picture (SVG 1.1, 190 mm wide) for each setup of the plan: the part
/// after the setup, half in section, with its stock and its clamping, as it stands in the
/// machine: the chuck to the left.  The axes are the program's (nc/program.hpp): zero in
/// the finished face of the free end, Z away from the chuck.  Setups count from 1.
///
/// Lengths are drawn with `scale` mm of paper per mm, along and across.  The distance of
/// the real surface from the nominal one is drawn as
///
///     y = scale factor e        [paper mm]                                      (1)
///
/// with the radius error e [mm] of an outer element or bore that the setup cuts, positive
/// outwards, and the largest factor of 1, 2, 5, 10, .. that keeps |y| within 6 mm in all
/// setups of the plan, so that its pictures can be compared.  A corrected tool path is
/// drawn in the same way, with its correction dr in place of e.  Errors of faces are not
/// drawn. Jaws are drawn as soft jaws bored to the part.  An element that no setup has
/// cut yet has its id without its size.  Equal plans give equal bytes.  Source: derived
/// here.
/// @throws std::domain_error if a number to be drawn is not finite, or there is no stock.
std::vector<std::string> setup_drawings(const planning::PreparedPart& part,
                                        const planning::ProcessPlan& plan);

}  // namespace turnwright::report
