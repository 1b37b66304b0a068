#include "measured_file.hpp"

#include <string_view>

namespace turnwright::document {
namespace {

bool is_utf8(const std::string& bytes) {
  try {
    (void)nlohmann::json(bytes).dump();
    return true;
  } catch (const nlohmann::json::type_error&) {
    return false;
  }
}

std::string from_latin_1(std::string_view bytes) {
  std::string out;
  for (const char c : bytes) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x80) {
      out += c;
    } else {
      out += static_cast<char>(0xC0 | (code >> 6));
      out += static_cast<char>(0x80 | (code & 0x3F));
    }
  }
  return out;
}

bool is_universal(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == text.npos || !text.substr(first).starts_with("-1")) return false;
  const auto behind = text.find_first_not_of(" \t\r", first + 2);
  return behind != text.npos && text[behind] == '\n';
}

/// Whether bytes stand among its lines.
bool is_binary_universal(std::string_view bytes) {
  return is_universal(bytes) && bytes.find("\n    58b ") != bytes.npos;
}

}  // namespace

nlohmann::json measured_file(const std::string& bytes) {
  std::string text =
      is_utf8(bytes) && !is_binary_universal(bytes) ? bytes : from_latin_1(bytes);
  if (is_universal(text)) return {{"uff", {{"text", std::move(text)}}}};
  return {{"csv", std::move(text)}};
}

}  // namespace turnwright::document
