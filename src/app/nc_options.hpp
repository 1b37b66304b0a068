#pragma once
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "turnwright/nc/text.hpp"

/// A shop's settings for NC programs as options of the command line: each member of the
/// request of `nc` beside its part, "program_number" as --program-number.
namespace turnwright::app {

/// Adds the options; those that are given become members of `settings`, as in the request.
/// @returns the options.
std::vector<CLI::Option*> add_nc_options(CLI::App& command, nlohmann::json& settings);

/// @throws InputError in which the command line is the document.
nc::Settings nc_settings(const nlohmann::json& settings);

}  // namespace turnwright::app
