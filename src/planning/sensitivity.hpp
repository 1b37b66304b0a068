#pragma once
#include <optional>
#include <vector>

#include "outcome.hpp"

/// What a change of the request does to a solved plan, to first order.
namespace turnwright::planning {

/// Change of the objective with every condition as it is: by the envelope theorem, for
/// each surface with the answer y*, its objective f and multipliers m,
///
///     d ln f* = d [ln f(y*) + sum_i m_i g_i(y*)] (1)
///
/// so that one expression holds for limits and for whatever else the model depends on:
/// compliances, rates, tool data.  Exact to first order where the same limits go on
/// binding and y* is the only optimum.
/// @return nothing where the changed request has not the same surfaces with the same
///   tools in the same setups, or leaves nothing of a tolerance.
/// Source: derived here; what re-solving gives in prices_test.
std::optional<double> first_order(const PreparedPart& plan,
                                  const std::vector<SolvedSetup>& solved,
                                  const PreparedPart& changed);

}  // namespace turnwright::planning
