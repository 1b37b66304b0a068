#pragma once
#include "auxiliary_work.hpp"
#include "planning/values/economy.hpp"

/// Milling operations of a setup: cutter, passes, speed and feed of least cost for which
/// the depth is stable with its margin at every speed within the margin of speed.
namespace turnwright::planning {

void add_milled(const PreparedPart& plan, std::size_t setup, Clamping clamping,
                const Economy& economy, AuxiliaryWork& out);

/// Adds the first losses of stability over the speeds of cutter and spindle, for
/// drawings.
void add_lobes(const PreparedPart& plan, OperationPlan& operation);

}  // namespace turnwright::planning
