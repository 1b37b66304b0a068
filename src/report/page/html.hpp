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
/// It says what text() (text.hpp) says, with the same numbers; every pass and constraint
/// is in the result document alone.  Text of the request is escaped.  Figures are placed
/// by their files' names: setup-<i>.svg beside its setup, budget.svg under the
/// tolerances, window-<operation>.svg of the four operations that cost most at the end.
/// Equal documents give equal bytes.
/// @param name  of the part, as the request has it.
std::string html(std::string_view name, const nlohmann::ordered_json& plan_result,
                 const std::vector<Figure>& figures);

}  // namespace turnwright::report
