#pragma once
#include <nlohmann/json.hpp>
#include <string>

/// A `stability` result in a machinist's words.
namespace turnwright::report {

/// "up to 4.2 mm", of a limit that may be null: "up to the largest depth asked for".
std::string stable_up_to(const nlohmann::ordered_json& parent);

/// The best cut: "9900 1/min, 4.17 mm deep", how it is limited, its margins.
std::string best_words(const nlohmann::ordered_json& best);

/// A requested cut: whether it chatters, at which frequency, and what helps.
std::string verdict_words(const nlohmann::ordered_json& point);

/// What limits each speed: "chatter at 902 Hz, stable again from 3.1 to 3.8 mm".
std::string limit_words(const nlohmann::ordered_json& speed);

}  // namespace turnwright::report
