#pragma once
#include <nlohmann/json.hpp>

#include "turnwright/document/catalogue.hpp"

namespace turnwright::document {

/// The capability `learn`: measured parts -> for each characteristic capability with
/// intervals, drift, wear, jumps at changes of the edge, advice for the next part, and what
/// was left out and why; on request factors of the models, and documents with them for the
/// next plan.  Computed by turnwright/learning and planning/factor_effects.hpp; the documents are described by
/// schemas/learn.request.json and schemas/learn.result.json.
/// @throws InputError with every problem of the request.
nlohmann::ordered_json learn(const nlohmann::json& request, const Catalogue& catalogue);

}  // namespace turnwright::document
