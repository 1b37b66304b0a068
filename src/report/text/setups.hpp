#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace turnwright::report {

/// Every setup of a `plan` result: the clamping, the reasons against the others, and the
/// table of its operations.
std::string setups(const nlohmann::ordered_json& plan_result);

}  // namespace turnwright::report
