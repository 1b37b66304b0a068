#pragma once
#include <optional>

#include "document/json/reader.hpp"
#include "measured_response.hpp"

namespace turnwright::document {

/// The response of {"unit", "uff": {"text", "record", "response", "reference"}}: one
/// frequency response of a universal file.  It is the one that `record` (its number among
/// the datasets 58) or the DOFs ask for, or else the only one, or the only one whose motion
/// and force are at one node along one axis.  Directions against each other, 1-X and 1+X,
/// change its sign.  A coherence of the same DOFs and abscissae belongs to it.
///
/// Its unit is that of the axis labels, or else of the data types in the units of dataset
/// 164, which must agree; `unit` counts in place of both.
/// Reported: what read_universal_file reports; no such record, or several; a record that is
/// no complex motion per force over frequency; units that are missing or contradict.
std::optional<MeasuredResponse> read_response_file(Reader& r);

}  // namespace turnwright::document
