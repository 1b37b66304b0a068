#pragma once
#include <nlohmann/json.hpp>

#include "turnwright/volumetric/machine.hpp"

namespace turnwright::document {

/// The capability `geometry`: a kinematic chain with its errors and positions -> tip and
/// direction errors.  Computed by volumetric/kinematics.hpp; the documents are described
/// by schemas/geometry.request.json and schemas/geometry.result.json.
/// @throws InputError with every problem of the request.
nlohmann::json geometry(const nlohmann::json& request);

/// The machine of the same request.
volumetric::Machine geometry_machine(const nlohmann::json& request);

}  // namespace turnwright::document
