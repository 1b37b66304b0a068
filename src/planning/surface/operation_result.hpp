#pragma once
#include <string>
#include <vector>

#include "surface_optimiser.hpp"

/// A feature's answer in the terms of the result document.
namespace turnwright::planning {

/// An optimised surface with its task.
struct SolvedSurface {
  SurfaceTask task;
  SurfaceAnswer answer;
  std::vector<std::string> operation_ids;  ///< given ids, rough first; may be empty
};

/// Cost per minute of the machine.
struct Rates {
  double machine_per_min = 0;
};

/// One plan entry per operation of the feature.
std::vector<OperationPlan> operation_results(const PreparedPart& plan, std::size_t setup,
                                             const SolvedSurface& solved,
                                             const Rates& rates);

/// Name of a row: "t1 cylindricity" for a tolerance, otherwise the name of its check.
std::string row_name(const PreparedPart& plan, const Chain& chain, const Row& row);

/// A row at a choice in its own unit, with its name.
ConstraintValue constraint(const PreparedPart& plan, const Chain& chain,
                           const Choice<double>& choice, const RowValue& row);

/// A value against the limit of a check.  The margin is ln(limit/value) for an upper
/// limit, ln(value/limit) for a lower one: negative if the limit is not kept.
ConstraintValue constraint(Check check, double value, double limit);

/// Minutes and edge cost of the answer's operations.
struct Spent {
  double cut_min = 0, air_min = 0, change_min = 0, edges_cost = 0;
};
Spent spent(const SurfaceAnswer& answer);

}  // namespace turnwright::planning
