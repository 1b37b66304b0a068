#pragma once
#include <optional>
#include <string>
#include <vector>

#include "machine_fields.hpp"

/// Calibrations saved as machine documents.
namespace turnwright::document {

/// A machine's document with its errors, or a chain without errors.
struct MachineDocument {
  nlohmann::json document;
  catalogue::GeometricErrors errors;
};

/// The optional member "machine": the document of a lathe to be calibrated.  One without
/// errors gets `chain`; `axes` are those that the calibration determines.  Nothing if the
/// member is absent or has problems.
std::optional<MachineDocument> read_machine_document(Reader& r, const std::string& chain,
                                                     const std::string& axes);

/// The document in which the errors found replace those it had.
nlohmann::json with_errors(MachineDocument machine, const std::vector<Calibrated>& found,
                           const std::string& source);

}  // namespace turnwright::document
