#include "turnwright/base/errors.hpp"

#include <utility>

#include "base/say.hpp"

namespace turnwright {
namespace {

std::string list(const std::string& document, const std::vector<Problem>& problems) {
  std::string text;
  for (const auto& p : problems) {
    if (!text.empty()) text += '\n';
    const auto place = document + ": " + (p.pointer.empty() ? tr("document") : p.pointer);
    text += visible(say("{}: got {}, expected {}", place, p.got, p.expected));
  }
  return text;
}

}  // namespace

std::string visible(std::string_view text) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    auto c = static_cast<unsigned char>(text[i]);
    // U+0080 to U+009F are two bytes of UTF-8 each.
    const auto next = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : 0);
    const bool second = c == 0xc2 && next >= 0x80 && next < 0xa0;
    if (second) c = static_cast<unsigned char>(text[++i]);
    if (second || c < 0x20 || c == 0x7f)
      out += std::string("\\u00") + kDigits[c >> 4] + kDigits[c & 15];
    else
      out += static_cast<char>(c);
  }
  return out;
}

InputError::InputError(std::string document, std::vector<Problem> problems)
    : std::runtime_error(list(document, problems)),
      document_(std::move(document)),
      problems_(std::move(problems)) {}

}  // namespace turnwright
