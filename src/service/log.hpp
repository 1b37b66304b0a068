#pragma once
#include <nlohmann/json.hpp>
#include <string>

/// The log: one JSON object a line, on standard error.
namespace turnwright::service {

void start_log();

/// Writes a line of the level in the function's name: time, level, then these members.
void log_info(const nlohmann::ordered_json& members);
void log_error(const nlohmann::ordered_json& members);

void log_event(const std::string& event, const std::string& detail);

}  // namespace turnwright::service
