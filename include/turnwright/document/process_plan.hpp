#pragma once
#include <nlohmann/json.hpp>
#include <vector>

#include "turnwright/document/prepared_part.hpp"
#include "turnwright/planning/process_plan.hpp"

namespace turnwright::document {

/// The result of `plan` (schemas/plan.result.json), keys in the order of the schema.
/// @throws ModelRangeError naming the pointer if a number is not finite: JSON would
///   turn it into null.
nlohmann::ordered_json to_json(const planning::ProcessPlan& plan,
                               const std::vector<Assumption>& assumed);

/// The same with the name of the part and what its title block says.
nlohmann::ordered_json plan_result(const planning::ProcessPlan& plan,
                                   const PreparedDocument& document);

/// The list `assumed` of a result.
nlohmann::ordered_json to_json(const std::vector<Assumption>& assumed);

}  // namespace turnwright::document
