#pragma once
#include <filesystem>
#include <optional>

namespace turnwright::library {

/// The data folder of the installation that the shared library belongs to; none if it is
/// not installed, or if TURNWRIGHT_DATA of the environment names another.
std::optional<std::filesystem::path> data_beside();

}  // namespace turnwright::library
