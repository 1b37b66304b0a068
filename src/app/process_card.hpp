#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace turnwright::app {

/// The result of `quote` as a workbook of Office Open XML (.xlsx): sheets "Prices",
/// "Routing" and "Ways", each with a row of headings.  Equal results give equal bytes.
/// @throws OutputError if the system's temporary folder does not take it.
std::string process_card(const nlohmann::ordered_json& quote);

}  // namespace turnwright::app
