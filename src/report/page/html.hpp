#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "report/picture/figure.hpp"
#include "report/sheet/setup_sheet.hpp"

namespace turnwright::report {

/// The result document of `plan` or `predict` (schemas/plan.result.json) as one HTML file
/// that needs nothing else: no script, no request, the pictures inside it.  The planner's
/// pages come first; every set-up sheet starts on a page of its own.
///
/// It has the contents of text() (text.hpp) with the same numbers; single passes and
/// constraints are only in the result document.  Text of the request is escaped.  Figures
/// are placed by their file names: setup-<n>.svg and path-<n>.svg on the sheets (without
/// sheets setup-<n>.svg above the setups), budget.svg below the tolerances,
/// window-<operation>.svg of the four most expensive operations behind the planner's
/// tables.  Setups count from 1.  Equal documents give equal bytes.
/// @param name  name of the part in the request.
std::string html(std::string_view name, const nlohmann::ordered_json& plan_result,
                 const std::vector<Figure>& figures,
                 const std::vector<SetupSheet>& sheets = {});

}  // namespace turnwright::report
