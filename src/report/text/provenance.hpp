#pragma once
#include <nlohmann/json.hpp>
#include <string>

/// Lines that the reports of several capabilities have in common.
namespace turnwright::report {

/// The program's version and the request from which a result comes; "" if it has neither.
std::string made_by(const nlohmann::ordered_json& result);

/// The list `assumed`, one line each: a long value gives way to the reason; "" if it is
/// empty.
std::string assumption_lines(const nlohmann::ordered_json& result);

/// The list `warnings`; "" if it is empty.
std::string warnings(const nlohmann::ordered_json& result);

}  // namespace turnwright::report
