#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace turnwright::document {

/// The JSON value in a file; `name` (by default the path) precedes every problem.
/// @throws InputError if the file cannot be read, is larger than ParseLimits allow, or is
///   not JSON that parse() accepts.
nlohmann::json parse_file(const std::filesystem::path& path, std::string name = "");

}  // namespace turnwright::document
