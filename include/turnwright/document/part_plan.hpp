#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "turnwright/document/catalogue.hpp"
#include "turnwright/planning/process_plan.hpp"

/// The part document (schemas/part.json): request of `plan` and `predict`.
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

/// Everything resolved and checked: ids to materials, machines and tools; fits to
/// deviations (ISO 286) and open sizes to the general tolerance (ISO 2768), each as a
/// tolerance "<element>:diameter" or "part:length"; defaults filled in and told in
/// `assumed`.
/// @throws InputError with all that is wrong, cross-references included.
LoadedPart load_part_plan(const nlohmann::json& json, const Catalogue& catalogue,
                          const std::string& document, Purpose purpose = Purpose::plan);

}  // namespace turnwright::document
