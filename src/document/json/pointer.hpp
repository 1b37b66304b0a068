#pragma once
#include <string>
#include <string_view>

namespace turnwright::document {

/// `pointer` with one more reference token, escaped as RFC 6901 wants ("~0", "~1").
std::string child_pointer(const std::string& pointer, std::string_view key);

}  // namespace turnwright::document
