#pragma once
#include <nlohmann/json.hpp>

#include "turnwright/volumetric/ball_bar.hpp"

namespace turnwright::document {

/// The capability `ballbar`: error model -> traces, or traces -> values of ISO 230-4 and
/// their decomposition.  Computed by volumetric/ball_bar.hpp; the documents are described
/// by schemas/ballbar.request.json and schemas/ballbar.result.json.
/// @throws InputError with every problem of the request; ModelRangeError if the angles do
///   not separate the errors.
nlohmann::json ball_bar(const nlohmann::json& request);

/// The trace of the same request, simulated or given.
volumetric::Trace ball_bar_trace(const nlohmann::json& request);

}  // namespace turnwright::document
