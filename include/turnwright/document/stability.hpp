#pragma once
#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>
#include <stop_token>

#include "turnwright/document/catalogue.hpp"

namespace turnwright::document {

/// Called with the number of speeds and points that are done.
using StabilityProgress = std::function<void(std::size_t done, std::size_t all)>;

/// The capability `stability`: dynamics of milling or turning -> limits per speed and
/// verdicts per point.  Computed by chatter/chart.hpp, modes of a measured response by
/// chatter/frf.hpp; the documents are described by schemas/stability.request.json and
/// schemas/stability.result.json.
/// @throws InputError with every problem of the request; ModelRangeError if a speed and
///   depth would take too long to search; Cancelled soon after a stop was requested.
nlohmann::ordered_json stability(const nlohmann::json& request,
                                 const Catalogue& catalogue = {},
                                 const std::stop_token& stop = {},
                                 const StabilityProgress& tell = {});

}  // namespace turnwright::document
