#pragma once
#include <vector>

#include "outcome.hpp"
#include "turnwright/planning/setup_geometry.hpp"

/// Every setup of a plan in the clamping and with the tools that serve an objective best.
namespace turnwright::planning {

/// The clampings of one setup.
struct Comparison {
  SolvedSetup chosen;
  std::vector<RejectedClamping> rejected;
  bool solved = false;
};

struct Attempt {
  std::vector<Comparison> setups;
  bool feasible = true;
  Breakdown breakdown;
  double objective = 0, lower_bound = 0;
};

/// At a given worth of a minute and an edge.
Attempt attempt(const PreparedPart& part, Economy economy);

/// For the plan's own objective.
Attempt best_attempt(const PreparedPart& part);

/// Of a plan that cannot be made: its conflicting sets of limits (conflict_sets.hpp) over
/// every recipe, how far each member would have to open for the others to be kept, and
/// what no limit decides.
void explain(const PreparedPart& plan, const Attempt& attempt, ProcessPlan& result);

}  // namespace turnwright::planning
