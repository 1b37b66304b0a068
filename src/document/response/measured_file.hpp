#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace turnwright::document {

/// The bytes of a measurement's file as the part of "frf" that holds them: {"uff": {"text"}}
/// where the first line is that of a universal file, or else {"csv"}.  What is no UTF-8 is
/// taken as ISO 8859-1, in which instruments write units.  A .frf of CutPro has the labels of
/// its three columns behind the values of its first line; they become a line of their own, so
/// that what is said of its lines counts one more.
nlohmann::json measured_file(const std::string& bytes);

}  // namespace turnwright::document
