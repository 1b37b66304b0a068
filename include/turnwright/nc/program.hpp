#pragma once
#include <string>
#include <vector>

#include "turnwright/planning/prepared_part.hpp"
#include "turnwright/planning/process_plan.hpp"
#include "turnwright/toolpath/setup_program.hpp"

/// Turning programs of a process plan, one for each setup.
///
/// Program zero is on the spindle's axis in the finished face of the free end, +Z away
/// from the chuck, whichever end of the part that is.  Tools are programmed at their
/// imaginary tip (path.hpp) with the control's radius compensation off (G40): the path
/// already allows for the corner.  Blades are programmed at their corner towards the
/// chuck, drills at their point, threading tools at theirs.
///
/// Operations follow in the plan's order with its conditions.  F, S and the spindle's
/// limit are cut off, never rounded up.  The paths need some rules in addition to the
/// plan's numbers:
///
///     approach    2 mm before the surface, 1 mm above (in bores 0.2 mm), the last part
///                 at feed; a pass that would start in the stock left on an element in
///                 front comes down through it on a slope that the minor edge clears, or
///                 starts in front of an element too short for that; a finishing pass that
///                 begins where a finished surface ends, and every arc, comes down on a
///                 slope of 45 deg onto its beginning
///     corners     keep the fillet of the corner's radius r where the contour rises; a
///                 pass ends where the corner touches the drawn contour behind, or r, the
///                 largest r of the plan's tools and 0.2 mm behind an edge that falls; where
///                 the part goes on level, 0.2 mm behind the edge
///     cones       are roughed parallel to themselves, as far as the stock reaches
///     walls       roughing ends the least depth of the finishing tool before them, and
///                 draws out along them as far as the pass was deep, so that no wedge of
///                 the lead angle stays; finishing runs along the whole contour, up its
///                 walls, and draws out to the top of the last one
///     shoulders   faced by the plan: turning leaves them their stock, the facing pass
///                 runs out along the smaller element, a cone too, to where turning ended;
///                 between bores along the wider one, after passes that have all drawn out
///                 as far as they were deep
///     lengths     shoulders stand where lengths to them are in the middles of their limits
///                 (planning/paths/programmed_faces.hpp)
///     faces       past the axis by r, of a hollow part past the hole by r + 0.2 mm
///     grooves     plunges side by side between the walls, the first at the chuck's
///     threads     radial infeeds, each from 3 pitches before, and from before what rises
///                 to the thread; where the part rises behind without a groove the thread
///                 ends one pitch early
///     parting     the blade's side towards the part at the face's allowance
///     tool change X and Z 50 mm clear of the stock
///
/// Source: derived here; program_test takes the canonical moves of an interpreter and
/// moves the tools' circles over the contour.
namespace turnwright::nc {

using namespace toolpath;

struct Programs {
  std::vector<SetupProgram> setups;  ///< empty for an infeasible plan
  /// Sentences on surfaces that would be cut wrong or cannot be reached (docs/nc.md lists
  /// the cases); `setups` is then empty.
  std::vector<std::string> cannot;
};

/// The programs of every setup of a plan.
Programs programs(const planning::PreparedPart& part, const planning::ProcessPlan& plan);

/// Makes a plan infeasible if it cannot be programmed; its conflicts give the reasons.  A
/// plan whose request itself turns from the chuck outwards is not changed.
void refuse_unprogrammed(const planning::PreparedPart& part, planning::ProcessPlan& plan);

}  // namespace turnwright::nc
