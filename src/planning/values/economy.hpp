#pragma once

namespace turnwright::planning {

/// Weights of the objective: of a minute, and of what edges and the stock cost.
struct Economy {
  double minute = 0, edge = 0;
};

}  // namespace turnwright::planning
