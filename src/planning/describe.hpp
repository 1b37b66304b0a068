#pragma once
#include <string>
#include <vector>

#include "feature_optimiser.hpp"

/// A feature's answer in the terms of the result document.
namespace turnwright::planning {

/// How a check is called, in what unit, and which of its two sides is the limit.
struct CheckName {
  const char* name;
  const char* unit;
  bool at_most;
};
CheckName check_name(Check check);

/// A surface that has been optimised, with what it was asked.
struct SolvedFeature {
  FeatureTask task;
  FeatureAnswer answer;
  bool compensated = false;                ///< the tool path takes out the error's mean
  std::vector<std::string> operation_ids;  ///< given ids, rough first; may be empty
};

/// Money per minute and what the objective counts.
struct Rates {
  double machine_per_min = 0;
};

/// One plan entry per operation of the feature.
std::vector<OperationPlan> describe(const PreparedPart& plan, std::size_t setup,
                                    const SolvedFeature& solved, const Rates& rates);

/// "t1 cylindricity" for a tolerance row, else the check's name.
std::string row_name(const PreparedPart& plan, const Chain& chain, const Row& row);

/// A row at a choice in its own unit, with its name.
ConstraintValue constraint(const PreparedPart& plan, const Chain& chain,
                           const Choice<double>& choice, const RowValue& row);

/// A value against its limit; the margin is in ln.
ConstraintValue constraint(std::string name, std::string unit, double value, double limit,
                           bool at_most = true);

/// Minutes and edge cost of the answer's operations.
struct Spent {
  double cut_min = 0, air_min = 0, change_min = 0, edges_cost = 0;
};
Spent spent(const FeatureAnswer& answer);

}  // namespace turnwright::planning
