#pragma once
#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <optional>

namespace turnwright::app {

/// Adds the command `import`, which prints the part document that a drawing becomes, so
/// that it can be piped to `plan -`; what was assumed and ignored goes to standard error.
/// @param data  receives the value of --data; must outlive the app.
void add_import(CLI::App& app, const std::optional<std::filesystem::path>& data,
                const std::function<void(std::function<void()>)>& chosen);

}  // namespace turnwright::app
