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

struct LoadedPart {
  planning::PlanRequest plan;
  std::vector<Assumption> assumed;
  nlohmann::json json;   ///< as it was read
  std::string document;  ///< what errors call it
  /// Of drawing.inner: cylinders that are bored and that a reamer would leave as they are
  /// drawn too.
  std::vector<std::size_t> reamable = {};
};

/// `predict` needs every operation with its tool and all its conditions.
enum class Purpose { plan, predict };

}  // namespace turnwright::document
