#pragma once
#include <nlohmann/json.hpp>

namespace turnwright::document {

/// The capability `acceptance`: deviations over features and their tolerances ->
/// verdicts. Each case is judged by tolerance::verdict() and by nothing else; the
/// documents are described by schemas/acceptance.request.json and
/// schemas/acceptance.result.json.
///
/// e_mm is a list of samples (with `z_mm` their positions, for straightness; absent:
/// equally spaced) or a piecewise polynomial {"breaks_mm", "coefficients"}: piece k on
/// [breaks_mm[k], breaks_mm[k + 1]] is sum_j coefficients[k][j] (z - breaks_mm[k])^j. For
/// a length it may be a list of two such profiles, one for each face, positive = longer.
/// A case with a "budget" gets an error budget of its uncertain sources, computed by
/// tolerance::budget().
/// @throws InputError with every problem of the request.
nlohmann::json acceptance(const nlohmann::json& request);

}  // namespace turnwright::document
