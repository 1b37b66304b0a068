#pragma once
#include <vector>

#include "solved_setup.hpp"

/// The order of the operations in a setup.
namespace turnwright::planning {

/// Place of a surface's operation in the order of a setup: faces first, then all
/// roughing, all finishing, shoulders, and the bores in the same way.
inline constexpr std::size_t kPlaces = 7, kFirstOfBores = 4;
std::size_t place_in_setup(MachinedSurface::Kind kind, bool rough);

/// The operations of a setup in the order of cutting: faces, centre hole and drilling,
/// roughing, finishing, shoulders, bores, then arcs, grooves, threads, parting off.
std::vector<OperationPlan> operations_in_order(const PreparedPart& plan,
                                               const SolvedSetup& setup);

}  // namespace turnwright::planning
