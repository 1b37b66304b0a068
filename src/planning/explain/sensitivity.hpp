#pragma once
#include <optional>
#include <vector>

#include "planning/setup/solved_setup.hpp"

/// Sensitivity of a solved plan to a change of the request, to first order.
namespace turnwright::planning {

/// Change of the objective with every condition held: by the envelope theorem, for each
/// surface with the optimum y*, its objective f and multipliers m,
///
///     d ln f* = d [ln f(y*) + sum_i m_i g_i(y*)] (1)
///
/// so that one expression holds for limits and for everything else that the model depends
/// on: compliances, hourly rates, tool data.  Exact to first order where the same limits
/// remain binding and y* is the only optimum.
/// @return nothing where the changed request has other surfaces, or other tools or setups
///   for them, or where nothing of a tolerance remains for the cut.
/// Source: [Fiacco 1983], the envelope theorem; prices_test compares with plans made
/// anew.
std::optional<double> first_order(const PreparedPart& plan,
                                  const std::vector<SolvedSetup>& solved,
                                  const PreparedPart& changed);

}  // namespace turnwright::planning
