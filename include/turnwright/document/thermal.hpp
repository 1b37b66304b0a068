#pragma once
#include <nlohmann/json.hpp>

namespace turnwright::document {

/// The capability `thermal`: a drift log -> the lag model fitted to it, its prediction
/// and residuals, the rows held out of the fit, a neural network beside it if requested,
/// and the drift over a planned shift and batch.  Computed by thermal/; the documents are
/// described by schemas/thermal.request.json and schemas/thermal.result.json.
/// @throws InputError with every problem of the request; ModelRangeError if the log does
///   not determine the model: too few rows, or a spindle that never turns.
nlohmann::json thermal(const nlohmann::json& request);

}  // namespace turnwright::document
