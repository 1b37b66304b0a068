#pragma once
#include "turnwright/review/cuts.hpp"

/// Forces, power, tool life and limits of a cut, by the laws of planning.
namespace turnwright::review {

/// Completes a cut: loads at the depth that prevails and at the largest, worn edges, and
/// the limits of tool, machine and jaws.  The jaws' force is that of roughing in the
/// setup's first clamping.  Of the first cut over a surface of a casting or forging in its
/// setup the first pass may take less than the tool's least depth: it meets what stands there.
enum class CutOrder { first, later };
void add_loads(const planning::PreparedPart& part, std::size_t setup,
               const MountedTool& tool, CutOrder order, Cut& cut);

}  // namespace turnwright::review
