#pragma once
#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <optional>

namespace turnwright::app {

/// Adds `turnwright serve`; `chosen` is called with what serves until it is told to stop.
void add_serve(CLI::App& app, const std::optional<std::filesystem::path>& data,
               const std::function<void(std::function<void()>)>& chosen);

}  // namespace turnwright::app
