#pragma once
#include <vector>

#include "feasibility.hpp"

/// Why a part cannot be made, as sets of its limits.
namespace turnwright::planning {

/// Indices into Feasibility::limits(), rising.
using LimitSet = std::vector<std::size_t>;

/// The limits of `kept` as they are, the others relaxed by one factor.
RelaxationFactors only(const Feasibility& oracle, const LimitSet& kept,
                       double others = kWithout);
/// The limits of `some` relaxed by one factor, the others as they are.
RelaxationFactors without(const Feasibility& oracle, const LimitSet& some,
                          double factor = kWithout);

/// Irreducible infeasible subsets of the limits: no recipe keeps such a set, and without
/// any one of its limits the rest of it can be kept.  The sets are disjoint, and the limits
/// in none of them can be kept all at once.  Sets of one limit come first; larger ones are
/// found by QuickXplain, which takes about 2 k log2(n/k) trials for a set of k among n
/// limits.  Surfaces that nothing makes even without any limit are left out of `oracle`.
/// Source: U. Junker, "QUICKXPLAIN: preferred explanations and relaxations for
/// over-constrained problems", AAAI 2004, pp. 167-172 (from general knowledge); the
/// disjoint sets and the choice of suspects: derived here.
std::vector<LimitSet> irreducible_conflicts(Feasibility& oracle);

}  // namespace turnwright::planning
