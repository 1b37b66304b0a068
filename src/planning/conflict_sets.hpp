#pragma once
#include <vector>

#include "feasibility.hpp"

/// Why a part cannot be made, as sets of its limits.
namespace turnwright::planning {

/// Indices into Feasibility::limits(), rising.
using LimitSet = std::vector<std::size_t>;

/// Each limit of some as it is, the others opened.
Openings only(const Feasibility& part, const LimitSet& kept, double others = kWithout);
/// Some limits opened, the others as they are.
Openings without(const Feasibility& part, const LimitSet& opened,
                 double times = kWithout);

/// Sets of limits that no recipe keeps, whatever else may go: irreducible, for without
/// any one of them the rest of its set is kept.  They share no limit, and what is in none
/// can be kept all at once.  Sets of one limit come first; larger ones are found by
/// halving: of two halves the second is searched with the first in place, then the first
/// with what the second gave, so a set of k among n limits takes about 2 k log2(n/k)
/// trials.
/// Surfaces that nothing makes though no limit be kept are left out of `part`.
/// Source: derived here.
std::vector<LimitSet> conflicting_sets(Feasibility& part);

}  // namespace turnwright::planning
