#pragma once
#include <nlohmann/json.hpp>
#include <string>

/// A certificate in words.
namespace turnwright::report {

/// "0.12 %" for a global certificate, otherwise its kind; "-" without a kind.
std::string gap(const nlohmann::ordered_json& certificate);

/// How much dearer than the best something unproven may be, "may be up to 1.4 % dearer
/// than the best".
std::string perhaps(const nlohmann::ordered_json& certificate);

/// A sentence for the plan's certificate.
std::string proof(const nlohmann::ordered_json& certificate);

}  // namespace turnwright::report
