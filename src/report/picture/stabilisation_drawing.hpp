#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace turnwright::report {

/// The stabilisation diagram of a measured response, an entry of `frf` of a `stability`
/// result (schemas/stability.result.json), as one self-contained picture (SVG 1.1, 190 mm
/// wide): the poles of models over frequency and order, with different marks for what they
/// share with the order below, before the magnitude of the response in dB of its highest
/// line.  Upright strokes are the fitted modes, dashed where they never become stable, and
/// what is stable but not fitted.  Equal results give equal bytes.
std::string stabilisation_drawing(const nlohmann::ordered_json& response);

}  // namespace turnwright::report
