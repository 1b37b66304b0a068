#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace turnwright::report {

/// Every setup of a `plan` result: how the part is held, why not otherwise, and the table
/// of its operations.
std::string setups(const nlohmann::ordered_json& plan_result);

}  // namespace turnwright::report
