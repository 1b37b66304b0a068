#pragma once
#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <optional>

namespace turnwright::app {

/// Adds the command `serve`; `chosen` is called with a function that serves until a
/// signal stops it.
void add_serve(CLI::App& app, const std::optional<std::filesystem::path>& data,
               const std::function<void(std::function<void()>)>& chosen);

}  // namespace turnwright::app
