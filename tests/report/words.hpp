#pragma once
#include <regex>
#include <string>

namespace turnwright::report {

inline bool has(const std::string& text, const std::string& part) {
  return text.find(part) != text.npos;
}

/// Blanks as one, so that widths do not matter.
inline std::string flat(const std::string& text) {
  return std::regex_replace(text, std::regex("[ ]+"), " ");
}

}  // namespace turnwright::report
