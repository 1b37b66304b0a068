#pragma once
#include <string>

namespace turnwright::app {

/// Prints a text report, with colours if standard output is a terminal that has them: its TERM
/// is known and not "dumb", and NO_COLOR is not set (no-color.org).
void print_report(const std::string& text);

}  // namespace turnwright::app
