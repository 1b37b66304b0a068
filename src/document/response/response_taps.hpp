#pragma once
#include <optional>

#include "document/json/reader.hpp"
#include "measured_response.hpp"

namespace turnwright::document {

/// The response of {"taps": {"csv", "columns", "units", "block_s", "left"}}: a table of time,
/// force and motion over one tap or several (chatter/tap_test.hpp).  Times that step back
/// begin a new record.
/// Reported: what read_measured_table reports; units that are missing or of other
/// quantities; times that are not evenly spaced, by line; no tap without fault, with the
/// fault of each.
std::optional<MeasuredResponse> read_response_taps(Reader& r);

}  // namespace turnwright::document
