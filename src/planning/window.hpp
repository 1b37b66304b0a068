#pragma once
#include <optional>

#include "describe.hpp"

namespace turnwright::planning {

/// The window of operation i of a solved surface (process_plan.hpp): with the finishing
/// depth, the passes and the other operation as chosen,
///
///     { (v, f): every limit is kept,
///               cost(v, f) <= (1 + percent/100) cost of the optimum }
///
/// where cost is the operation's own part of the objective.  For each feed the speeds are
/// one interval, for the cost falls and then rises with the speed and every limit of the
/// speed is one of its ends; so the window lies between two curves over the feeds.
///
/// The feeds are those about the optimum's that are connected with it: 24 to either side
/// are looked at, and the first that is refused is closed in on by bisection.  Both
/// curves are cut where another limit takes over, and followed until chords leave them by
/// less than 1e-4 of the speed, in logarithms and in the plane; where a chord would leave
/// the window its vertices move inwards by as much, so that the polygon holds nothing
/// else. Nothing if the request fixes speed or feed, or the window has no area. Source:
/// derived here; window_test predicts its vertices and points inside and outside.
std::optional<OperatingWindow> operating_window(const PreparedPart& plan,
                                                const SolvedFeature& solved,
                                                std::size_t i);

}  // namespace turnwright::planning
