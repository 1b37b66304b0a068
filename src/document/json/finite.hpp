#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace turnwright::document {

/// Checks that all numbers are finite: JSON has no NaN, which would be written as null
/// and read as absent.
/// @param where  text before the pointer of the offending number.
/// @throws ModelRangeError if a number in `value` is not finite.
void require_finite(const nlohmann::json& value, const std::string& where);
void require_finite(const nlohmann::ordered_json& value, const std::string& where);

}  // namespace turnwright::document
