#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "parse.hpp"

namespace turnwright::document {

/// The JSON value in a file; `name` (by default the path) precedes every problem.
/// @throws InputError if the file cannot be read, is larger than `limits` allow, or is
///   not JSON that parse() accepts.
nlohmann::json parse_file(const std::filesystem::path& path, std::string name = "",
                          const ParseLimits& limits = kLocalLimits);

}  // namespace turnwright::document
