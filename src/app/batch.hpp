#pragma once
#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <optional>

namespace turnwright::app {

/// Adds `batch`; `chosen` is called with the work when the user asks for it.
/// @param data  where --data is put; must outlive the app.
void add_batch(CLI::App& app, const std::optional<std::filesystem::path>& data,
               const std::function<void(std::function<void()>)>& chosen);

}  // namespace turnwright::app
