#pragma once
#include <nlohmann/json.hpp>

namespace turnwright::document {

/// The capability `deflection`: shaft, clamping and load -> flexibilities, deflections
/// and slopes at positions, and the largest radius error over the length; optionally the
/// form of a face, or the tip of a boring bar.  Computed by deflection/ and by nothing
/// else; the documents are described by schemas/deflection.request.json and
/// schemas/deflection.result.json.
/// @throws InputError with every problem of the request; ModelRangeError where a force
///   law has no equilibrium or a result is beyond what a double holds.
nlohmann::json deflection(const nlohmann::json& request);

}  // namespace turnwright::document
