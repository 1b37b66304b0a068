#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

/// Reading a result document that may lack keys.
namespace turnwright::report {

/// The array under a key; an empty one if there is none.
const nlohmann::ordered_json& list(const nlohmann::ordered_json& parent, const char* key);

/// The object under a key; an empty one if there is none.
const nlohmann::ordered_json& object(const nlohmann::ordered_json& parent,
                                     const char* key);

/// The string under a key; "" if there is none.
std::string word(const nlohmann::ordered_json& parent, const char* key);

/// The number under a key.
std::optional<double> number(const nlohmann::ordered_json& parent, const char* key);

bool flag(const nlohmann::ordered_json& parent, const char* key);

/// The number with a given number of decimals, beyond 1e7 with 4 digits and an exponent;
/// "-" without a number.
std::string shown(std::optional<double> value, int decimals);

/// The number with a given number of significant digits, with an exponent if that is
/// shorter; "-" without a number.
std::string significant(std::optional<double> value, int digits = 4);

/// "a, b, c"
std::string joined(const std::vector<std::string>& words, const char* between = ", ");

}  // namespace turnwright::report
