#pragma once
#include <nlohmann/json.hpp>
#include <stop_token>

namespace turnwright::document {

/// The door `stability`: dynamics of milling or turning -> limits per speed and verdicts
/// per point.  Computed by milling/limits.hpp; the documents are described by
/// schemas/stability.request.json and schemas/stability.result.json.
/// @throws InputError with every problem of the request; ModelRangeError if a speed and
///   depth would take too long to search; Cancelled soon after `stop` was asked for.
nlohmann::ordered_json stability(const nlohmann::json& request,
                                 const std::stop_token& stop = {});

}  // namespace turnwright::document
