#pragma once
#include <nlohmann/json.hpp>
#include <string>

/// Lines that the reports of several doors have in common.
namespace turnwright::report {

/// The program and the request a result comes from; "" where the result does not say.
std::string made_by(const nlohmann::ordered_json& result);

/// The list `warnings`; "" if it is empty.
std::string warnings(const nlohmann::ordered_json& result);

}  // namespace turnwright::report
