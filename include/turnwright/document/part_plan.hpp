#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "turnwright/document/catalogue.hpp"
#include "turnwright/document/loaded_part.hpp"

/// The part document (schemas/part.json): request of `plan` and `predict`.
namespace turnwright::document {

/// The document with everything resolved and checked: ids to materials, machines and
/// tools; fits to deviations (ISO 286) and sizes without limits to the general tolerance
/// (ISO 2768), each as a tolerance "<element>:diameter" or "part:length"; defaults are
/// filled in and listed in `assumed`.
/// @throws InputError with all errors, including those of cross-references.
LoadedPart load_part_plan(const nlohmann::json& json, const Catalogue& catalogue,
                          const std::string& document, Purpose purpose = Purpose::plan);

}  // namespace turnwright::document
