#pragma once
#include <optional>

#include "irreducible_conflicts.hpp"

namespace turnwright::planning {

/// How exactly the least relaxation is found: a factor this much smaller is refuted.
inline constexpr double kRelaxationStep = 1.006;

/// The least factor of one limit that makes the part feasible, the others relaxed as in
/// `factors`; nothing if no factor does.  A limit that holds or not comes back as
/// kWithout.  Limits that scale rows of a model - tolerances, roughness, power, forces,
/// tool lives, chatter - start from what a local search needs and go down to what is
/// refuted; grip and spindle speeds are bisected.  The factor is rounded up to four digits
/// of the value that is reported, and verified as rounded.
std::optional<double> least_relaxation(Feasibility& oracle, std::size_t limit,
                                       RelaxationFactors factors);

}  // namespace turnwright::planning
