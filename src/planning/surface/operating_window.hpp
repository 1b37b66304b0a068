#pragma once
#include <optional>

#include "operation_result.hpp"

namespace turnwright::planning {

/// The window of operation i of a solved surface (process_plan.hpp): with the finishing
/// depth, the passes and the other operation as chosen,
///
///     { (v, f): every limit is kept,
///               cost(v, f) <= (1 + percent/100) cost of the optimum }
///
/// where cost is the operation's own part of the objective.  For each feed the allowed
/// speeds are one interval, because the cost falls and then rises with the speed and
/// every limit of the speed is one of its ends.  So the window lies between two curves
/// over the feeds.
///
/// The feeds are those connected with the optimum's: 24 to either side are tested, and
/// the boundary before the first that is not allowed is found by bisection.  Both curves
/// have corners where another limit takes over, and are followed until chords deviate
/// from them by less than 1e-4 of the speed, in logarithms and in the plane.  Where a
/// chord would leave the window its vertices are moved inwards by the same amount, so
/// that the polygon contains only allowed conditions.  Nothing if the request fixes speed
/// or feed, or the window has no area.
/// Source: derived here; operating_window_test predicts its vertices and points inside and outside.
std::optional<OperatingWindow> operating_window(const PreparedPart& plan,
                                                const SolvedSurface& solved,
                                                std::size_t i);

}  // namespace turnwright::planning
