#include "utf8.hpp"

#include <nlohmann/json.hpp>

namespace turnwright::document {

std::string shortened(const std::string& text, std::size_t bytes) {
  if (text.size() <= bytes) return text;
  while (bytes > 0 && (static_cast<unsigned char>(text[bytes]) & 0xC0) == 0x80) --bytes;
  return text.substr(0, bytes);
}

std::string readable(std::string text) {
  try {
    nlohmann::json(text).dump();
    return text;
  } catch (const nlohmann::json::type_error&) {
    std::string out;
    for (const unsigned char c : text) {
      if (c >= 0x80) out += static_cast<char>(0xC0 | c >> 6);
      out += static_cast<char>(c < 0x80 ? c : 0x80 | (c & 0x3F));
    }
    return out;
  }
}

}  // namespace turnwright::document
