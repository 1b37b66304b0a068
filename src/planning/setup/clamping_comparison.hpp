#pragma once
#include <vector>

#include "planning/values/economy.hpp"
#include "solved_setup.hpp"

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

}  // namespace turnwright::planning
