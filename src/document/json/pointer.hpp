#pragma once
#include <string>
#include <string_view>

namespace turnwright::document {

/// `pointer` with a further reference token, escaped by RFC 6901 ("~0", "~1").
std::string child_pointer(const std::string& pointer, std::string_view key);

}  // namespace turnwright::document
