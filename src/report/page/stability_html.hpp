#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "report/picture/figure.hpp"

namespace turnwright::report {

/// A `stability` result as one HTML file to print, in the form of html(): the chart, the
/// data of the model, verdicts and limits (at most 40 rows of each), and assumed values.
/// @param figures  with stability.svg.
std::string stability_html(std::string_view name, const nlohmann::ordered_json& result,
                           const std::vector<Figure>& figures);

}  // namespace turnwright::report
