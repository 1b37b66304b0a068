#pragma once
#include <nlohmann/json.hpp>

#include "turnwright/volumetric/compensation.hpp"

namespace turnwright::document {

/// The capability `compensate`: an NC program and a machine's errors -> the corrected
/// program and the remaining errors.  Computed by volumetric/compensation.hpp; the
/// documents are described by schemas/compensate.request.json and
/// schemas/compensate.result.json.
/// @throws InputError with every problem of the request; those of the program point at
///   its lines, "/program#line 12".
nlohmann::json compensate(const nlohmann::json& request);

struct CompensateAnswer {
  nlohmann::json result;
  volumetric::Compensated compensated;
};
/// The result with the data from which it was computed.
CompensateAnswer compensated(const nlohmann::json& request);

}  // namespace turnwright::document
