#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace turnwright::document {

/// The bytes of a measurement's file as the part of "frf" that holds them: {"uff": {"text"}}
/// where the first line is that of a universal file, or else {"csv"}.  What is no UTF-8 is
/// taken as ISO 8859-1, in which instruments write units.
nlohmann::json measured_file(const std::string& bytes);

}  // namespace turnwright::document
