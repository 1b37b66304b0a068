#pragma once
#include "turnwright/review/cuts.hpp"

/// Forces, power, tool life and limits of a cut, by the laws of planning.
namespace turnwright::review {

/// Completes a cut: loads at the depth that prevails and at the largest, worn edges, and
/// the limits of tool, machine and jaws.  The jaws' force is that of roughing in the
/// setup's first clamping.
void add_loads(const planning::PreparedPart& part, std::size_t setup,
               const MountedTool& tool, Cut& cut);

}  // namespace turnwright::review
