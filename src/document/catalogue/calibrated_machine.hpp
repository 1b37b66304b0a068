#pragma once
#include <optional>
#include <string>
#include <vector>

#include "machine_fields.hpp"

/// Calibrations saved as machine documents.
namespace turnwright::document {

/// A machine's document with the errors it has, or a chain without any.
struct MachineDocument {
  nlohmann::json document;
  catalogue::GeometricErrors errors;
};

/// Member "machine": a lathe's document, absent or to be calibrated.  One without errors
/// gets `chain`; `axes` are those that the calibration speaks of.
/// Nothing if it is absent or has problems.
std::optional<MachineDocument> read_machine_document(Reader& r, const std::string& chain,
                                                     const std::string& axes);

/// The document with what was found in the place of what it had.
nlohmann::json with_errors(MachineDocument machine, const std::vector<Calibrated>& found,
                           const std::string& source);

}  // namespace turnwright::document
