#pragma once
#include <nlohmann/json.hpp>

#include "turnwright/document/catalogue.hpp"

namespace turnwright::document {

/// The capability `calibrate-material`: measured cuts -> constants of the material with
/// confidence intervals, and the material's document with them in place of the old ones.
/// Computed by cutting/material_fit.hpp, force_fit.hpp, life_fit.hpp, life_scatter.hpp and
/// roughness_fit.hpp; the documents are described by
/// schemas/calibrate-material.request.json and schemas/calibrate-material.result.json.
/// @throws InputError with every problem of the request, among them cuts that do not
///   determine a constant, with the cuts that are missing.
nlohmann::json calibrate_material(const nlohmann::json& request,
                                  const Catalogue& catalogue);

}  // namespace turnwright::document
