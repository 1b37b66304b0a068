#pragma once
#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <optional>

namespace turnwright::app {

/// Adds the command `review`, which takes NC programs beside a part document, or a request.
void add_review(CLI::App& app, const std::optional<std::filesystem::path>& data,
                const std::function<void(std::function<void()>)>& chosen);

}  // namespace turnwright::app
