#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "report/picture/figure.hpp"

namespace turnwright::report {

/// The result document of `plan` or `predict` (schemas/plan.result.json) as one HTML file
/// that needs nothing else: no script, no request, the pictures inside it.  Printed it
/// takes two to four pages of A4.
///
/// It has the contents of text() (text.hpp) with the same numbers; single passes and
/// constraints are only in the result document.  Text of the request is escaped.  Figures
/// are placed by their file names: setup-<i>.svg beside its setup, budget.svg below the
/// tolerances, window-<operation>.svg of the four most expensive operations at the end.
/// Equal documents give equal bytes.
/// @param name  name of the part in the request.
std::string html(std::string_view name, const nlohmann::ordered_json& plan_result,
                 const std::vector<Figure>& figures);

}  // namespace turnwright::report
