#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "turnwright/document/prepared_part.hpp"
#include "turnwright/nc/text.hpp"

namespace turnwright::document {

/// The request of `nc` (schemas/nc.request.json): a part document and the shop's settings.
struct NcRequest {
  Candidates part = {};
  nc::Settings settings = {};
};

/// @throws InputError with every problem, those of the part below "/part".
NcRequest load_nc_request(const nlohmann::json& json, const Catalogue& catalogue);

/// The settings alone, as they stand beside the part in the request.
/// @throws InputError with every problem.
nc::Settings load_nc_settings(const nlohmann::json& json, const std::string& document);

/// A program's file name, "setup-1.ngc" of the first setup for LinuxCNC.
std::string file_name(const toolpath::SetupProgram& program, gcode::Control control);

/// The result of `nc` (schemas/nc.result.json).
nlohmann::ordered_json to_json(const nc::Programs& programs,
                               const planning::ProcessPlan& plan,
                               const nc::Settings& settings);

}  // namespace turnwright::document
