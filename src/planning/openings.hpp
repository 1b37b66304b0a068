#pragma once
#include <optional>

#include "conflict_sets.hpp"

namespace turnwright::planning {

/// How exactly the least opening is found: one by this much less is refuted.
inline constexpr double kOpening = 1.006;

/// The least opening of one limit, the others opened as in `times`: what is given by
/// leaving it; what scales rows of the model - tolerances, roughness, powers, forces,
/// tool lives, chatter - from what a local search needs down to what is refuted; grip and
/// spindle speeds by bisection.  Rounded up to four digits of the value told, and
/// verified as rounded. Nothing if it does not help.
std::optional<double> least_opening(Feasibility& part, std::size_t limit, Openings times);

/// An opening as it is told: the value of the limit rounded up to four digits.
double as_told(const LimitName& limit, double times);

/// A limit's value once opened.
double opened_value(const LimitName& limit, double times);

}  // namespace turnwright::planning
