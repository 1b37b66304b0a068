#pragma once
#include <nlohmann/json.hpp>

namespace turnwright::document {

/// The capability `compare`: two calibrations with repeated runs -> agreement per
/// parameter. Computed by volumetric/agreement.hpp; the documents are described by
/// schemas/compare.request.json and schemas/compare.result.json.
/// @throws InputError with every problem of the request.
nlohmann::json compare(const nlohmann::json& request);

}  // namespace turnwright::document
