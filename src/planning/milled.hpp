#pragma once
#include "fixed.hpp"

/// Milled places of a setup: cutter, passes, speed and feed of least cost whose depth is
/// stable with its margin at every speed within the margin of speed.
namespace turnwright::planning {

void add_milled(const PreparedPart& plan, std::size_t setup, Clamping clamping,
                const Economy& economy, FixedWork& out);

/// Adds the first losses over the speeds of cutter and spindle, to be drawn.
void add_lobes(const PreparedPart& plan, OperationPlan& operation);

}  // namespace turnwright::planning
