#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "turnwright/planning/process_plan.hpp"

namespace turnwright::document {

/// A value the document left out.
struct Assumption {
  std::string pointer;   ///< where it would stand
  nlohmann::json value;  ///< what was taken, as it would be written there
  std::string why;
};

struct LoadedPart {
  planning::PartPlan plan;
  std::vector<Assumption> assumed;
  std::vector<planning::WhatIf> what_if = {};
};

/// `predict` needs every operation with its tool and all its conditions.
enum class Purpose { plan, predict };

}  // namespace turnwright::document
