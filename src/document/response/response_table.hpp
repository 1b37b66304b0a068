#pragma once
#include <optional>

#include "document/json/reader.hpp"
#include "measured_response.hpp"

namespace turnwright::document {

/// The response of {"csv", "unit", "phase_unit", "columns"}: a table of frequency and of
/// real and imaginary part, or of magnitude (also in dB) and phase, maybe with coherence;
/// where it has both pairs, the parts count.
/// Reported: what read_measured_table reports, units that are missing or contradict each
/// other, values outside their range, frequencies that do not rise.
std::optional<MeasuredResponse> read_response_table(Reader& r);

}  // namespace turnwright::document
