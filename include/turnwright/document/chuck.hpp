#pragma once
#include <nlohmann/json.hpp>

namespace turnwright::document {

/// The capability `chuck`: test cuts -> the chuck's compliance with its uncertainties, or
/// what the planned cuts would determine if no error is given; and a deviation graph ->
/// its polynomial and the carriage's steps.  Computed by
/// deflection/chuck_identification.hpp and deflection/deviation_graph.hpp; the documents
/// are described by schemas/chuck.request.json and schemas/chuck.result.json.
/// @throws InputError with every problem of the request, among them cuts that do not
///   determine the compliance, with the cuts that are missing.
nlohmann::json chuck(const nlohmann::json& request);

}  // namespace turnwright::document
