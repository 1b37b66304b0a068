#pragma once
#include <string>

#include "html_parts.hpp"
#include "report/sheet/setup_sheet.hpp"

namespace turnwright::report {

/// A set-up sheet on a page of its own, with the picture setup-<n>.svg of `figures`, and
/// behind it the page of its tool path, path-<n>.svg.  Nothing on it is the planner's
/// alone: no cost, no window, no proof.
std::string sheet_html(const SetupSheet& sheet, const Figures& figures);

}  // namespace turnwright::report
