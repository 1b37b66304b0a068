#pragma once
#include <nlohmann/json.hpp>

namespace turnwright::document {

/// The capability `samba`: strategy -> identifiable parameters; with readings, the
/// parameters with their uncertainties.  Computed by volumetric/samba.hpp; the documents
/// are described by schemas/samba.request.json and schemas/samba.result.json.
/// @throws InputError with every problem of the request.
nlohmann::json samba(const nlohmann::json& request);

}  // namespace turnwright::document
