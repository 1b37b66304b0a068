#include "terminal.hpp"

#include <fmt/format.h>

#include "layout.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::report {
namespace {

constexpr int kBold = 1, kRed = 31, kGreen = 32, kYellow = 33;

std::string with(int style, std::string_view text) {
  return fmt::format("\x1b[{}m{}\x1b[0m", style, text);
}

int style_of_status(std::string_view said) {
  if (said.starts_with(translated("every limit is kept"))) return kGreen;
  return said.starts_with(translated("kept nominally only")) ? kYellow : kRed;
}

// Bytes of the capital letter at the beginning of a text; 0 if there is none.
std::size_t capital(std::string_view text) {
  for (const std::string_view umlaut : {"\u00c4", "\u00d6", "\u00dc"})
    if (text.starts_with(umlaut)) return umlaut.size();
  return !text.empty() && text[0] >= 'A' && text[0] <= 'Z' ? 1 : 0;
}

// The capitals, digits and blanks at the beginning of a line up to what is set off from them.
std::string_view heading(std::string_view line) {
  const auto text = line.substr(0, line.find("  "));
  if (characters(text) <= 3 || capital(text) == 0) return {};
  for (auto rest = text; !rest.empty();) {
    const bool other = (rest[0] >= '0' && rest[0] <= '9') || rest[0] == ' ';
    const auto bytes = other ? 1 : capital(rest);
    if (bytes == 0) return {};
    rest.remove_prefix(bytes);
  }
  return text;
}

}  // namespace

std::string styled(std::string_view line) {
  const auto status = translated("status  ");
  if (line.starts_with(status)) {
    const auto said = line.substr(status.size());
    return std::string(status) + with(style_of_status(said), said);
  }
  const auto title = heading(line);
  if (title.empty()) return std::string(line);
  return with(kBold, title) + std::string(line.substr(title.size()));
}

}  // namespace turnwright::report
