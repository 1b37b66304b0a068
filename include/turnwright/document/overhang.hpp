#pragma once
#include <nlohmann/json.hpp>
#include <stop_token>

#include "turnwright/document/catalogue.hpp"
#include "turnwright/document/stability.hpp"

namespace turnwright::document {

/// The capability `overhang`: the receptance of a spindle, holder, tool and a list of
/// overhangs -> the modes at the tool's tip and the stability limits of a cut with each.
/// Computed by chatter/receptance_coupling.hpp, frf.hpp and chart.hpp; the documents are
/// described by schemas/overhang.request.json and schemas/overhang.result.json.
/// @param tell  called with the number of overhangs that are done.
/// @throws InputError with every problem of the request; Cancelled soon after a stop was
///   requested.
nlohmann::ordered_json overhang(const nlohmann::json& request,
                                const Catalogue& catalogue = {},
                                const std::stop_token& stop = {},
                                const StabilityProgress& tell = {});

}  // namespace turnwright::document
