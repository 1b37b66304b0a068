#pragma once
#include <optional>
#include <string>

/// Times and money, rounded for reading; "-" without a value.
namespace turnwright::report {

/// "2.6 s", "41 s", "3 min 24 s", from ten minutes on "31 min".
std::string duration(std::optional<double> minutes);

/// Seconds with one decimal, for a column of a table.
std::string seconds(std::optional<double> minutes);

/// At least two decimals and three digits: "12.35", "0.0131".
std::string money(std::optional<double> value);

}  // namespace turnwright::report
