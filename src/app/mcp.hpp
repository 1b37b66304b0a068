#pragma once
#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <optional>

namespace turnwright::app {

/// Adds the command `mcp`, which answers the Model Context Protocol over standard input and
/// output until the input ends.
/// @param data  receives the value of --data; must outlive the app.
void add_mcp(CLI::App& app, const std::optional<std::filesystem::path>& data,
             const std::function<void(std::function<void()>)>& chosen);

}  // namespace turnwright::app
