#pragma once
#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <optional>

namespace turnwright::app {

/// Adds the command `batch`; `chosen` is called with its work when the user chooses it.
/// @param data  receives the value of --data; must outlive the app.
void add_batch(CLI::App& app, const std::optional<std::filesystem::path>& data,
               const std::function<void(std::function<void()>)>& chosen);

}  // namespace turnwright::app
