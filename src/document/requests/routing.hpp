#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "turnwright/planning/quote.hpp"

namespace turnwright::document {

/// Rows of a routing, one for each setup: minutes to prepare the machine once, and for each
/// part.
nlohmann::ordered_json routing_rows(const std::string& part, const std::string& made_by,
                                    const planning::Offer& offer);

/// The rows as CSV with a header (RFC 4180).  A cell that a spreadsheet would take for a
/// formula gets an apostrophe in front.
std::string routing_csv(const nlohmann::ordered_json& rows);

}  // namespace turnwright::document
