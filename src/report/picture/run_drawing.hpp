#pragma once
#include <nlohmann/json.hpp>
#include <vector>

#include "figure.hpp"

namespace turnwright::report {

/// A picture for each characteristic of the result of `learn`, run-1.svg, ..: its values in
/// the order of making as deviations from the nominal size, limits, the fit within edges,
/// changes of the edge, values that were left out, and the advice for the next part.
std::vector<Figure> run_drawings(const nlohmann::ordered_json& learn_result);

}  // namespace turnwright::report
