#pragma once
#include <vector>

#include "planning/paths/operation_gaps.hpp"
#include "turnwright/planning/process_plan.hpp"

/// The operations of a setup other than turning and boring.
namespace turnwright::planning {

/// One of them with its times and costs outside its entry in the result.
struct AuxiliaryOperation {
  OperationPlan plan;
  double air_min = 0;     ///< feed beside the cut, approach and return
  double change_min = 0;  ///< changing worn edges
  double edges_cost = 0;  ///< of worn edges
  double open = 0;        ///< objective less its lower bound
  InOrder order = {};
  double minutes() const { return plan.time_min + air_min + change_min; }
};

struct AuxiliaryWork {
  std::vector<AuxiliaryOperation> before, after;  ///< turning and boring
  std::vector<Conflict> conflicts;  ///< no tool, no room, no operation given
  std::vector<AuxiliaryOperation> all() const;
  double minutes() const;
  double edges_cost() const;
  double open() const;  ///< of all, objective less lower bound
};

}  // namespace turnwright::planning
