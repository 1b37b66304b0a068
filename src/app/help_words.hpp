#pragma once
#include <CLI/CLI.hpp>

namespace turnwright::app {

/// What CLI11 itself says in the help and of a wrong command line, in the program's language.
/// To be called once the app has all its commands and options.
void speak_in_help(CLI::App& app);

}  // namespace turnwright::app
