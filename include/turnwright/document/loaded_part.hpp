#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "turnwright/planning/plan_request.hpp"

namespace turnwright::document {

/// A value the document left out.
struct Assumption {
  std::string pointer;   ///< where it would stand
  nlohmann::json value;  ///< what was taken, as it would be written there
  std::string why;
};

/// A cylinder of drawing.inner that is bored and that tools on the axis would leave as it is
/// drawn too.
struct DrillableBore {
  std::size_t inner = 0;
  std::string how;  ///< "drilled", "reamed", "counterbored"
};

struct LoadedPart {
  planning::PlanRequest plan;
  std::vector<Assumption> assumed;
  nlohmann::json json;   ///< as it was read
  std::string document;  ///< what errors call it
  std::vector<DrillableBore> drillable = {};
};

/// `predict` needs every operation with its tool and all its conditions.
enum class Purpose { plan, predict };

}  // namespace turnwright::document
