#pragma once
#include <nlohmann/json.hpp>

#include "turnwright/volumetric/positioning.hpp"

namespace turnwright::document {

/// The capability `positioning`: readings of a laser along an axis, a compensation file of
/// LinuxCNC or a machine's errors -> values of ISO 230-2, the readings as a table of machine
/// documents, and a compensation file.  Computed by volumetric/positioning.hpp and
/// volumetric/linuxcnc_compensation.hpp; the documents are described by
/// schemas/positioning.request.json and schemas/positioning.result.json.
/// @throws InputError with every problem of the request.
nlohmann::ordered_json positioning(const nlohmann::json& request);

struct PositioningAnswer {
  nlohmann::ordered_json result;
  char axis = 'X';
  volumetric::Iso230_2 values;
};
/// The result with the values from which it was computed.
PositioningAnswer positioned(const nlohmann::json& request);

}  // namespace turnwright::document
