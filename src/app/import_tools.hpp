#pragma once
#include <CLI/CLI.hpp>
#include <functional>

namespace turnwright::app {

/// Adds the command `import-tools`, which prints the documents that a tool library becomes,
/// or writes one file each; what was assumed, contradicts itself and was ignored then goes
/// to standard error.
void add_import_tools(CLI::App& app,
                      const std::function<void(std::function<void()>)>& chosen);

}  // namespace turnwright::app
