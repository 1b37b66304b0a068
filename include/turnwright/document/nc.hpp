#pragma once
#include <nlohmann/json.hpp>

#include "turnwright/document/prepared_part.hpp"
#include "turnwright/nc/program.hpp"

namespace turnwright::document {

/// The request of `nc` (schemas/nc.request.json): a part document and the control.
struct NcRequest {
  PreparedDocument part = {};
  nc::Control control = nc::Control::linuxcnc;
};

/// @throws InputError with every problem, those of the part below "/part".
NcRequest load_nc_request(const nlohmann::json& json, const Catalogue& catalogue);

/// A program's file name, "setup-0.ngc"; of a Fanuc control "setup-0.nc".
std::string file_name(const nc::SetupProgram& program, nc::Control control);

/// The result of `nc` (schemas/nc.result.json).
nlohmann::ordered_json to_json(const nc::Programs& programs,
                               const planning::ProcessPlan& plan, nc::Control control);

}  // namespace turnwright::document
