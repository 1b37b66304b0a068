#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "report/picture/figure.hpp"

namespace turnwright::report {

/// A `stability` result as one HTML file to print, of the kind of html(): the chart, what the
/// limits rest on, verdicts, limits - at most 40 rows of each - and what was assumed.
/// @param figures  with stability.svg.
std::string stability_html(std::string_view name, const nlohmann::ordered_json& result,
                           const std::vector<Figure>& figures);

}  // namespace turnwright::report
