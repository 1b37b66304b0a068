#include "terminal.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace turnwright::report {
namespace {

constexpr int kBold = 1, kRed = 31, kGreen = 32, kYellow = 33;

std::string with(int style, std::string_view text) {
  return fmt::format("\x1b[{}m{}\x1b[0m", style, text);
}

int style_of_status(std::string_view said) {
  if (said.starts_with("every limit is kept")) return kGreen;
  return said.starts_with("kept nominally only") ? kYellow : kRed;
}

// The capitals, digits and blanks at the beginning of a line up to what is set off from them.
std::string_view heading(std::string_view line) {
  const auto text = line.substr(0, line.find("  "));
  const bool capitals = std::ranges::all_of(text, [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == ' ';
  });
  const bool word = text.size() > 3 && text[0] >= 'A' && text[0] <= 'Z';
  return capitals && word ? text : std::string_view();
}

}  // namespace

std::string styled(std::string_view line) {
  constexpr std::string_view kStatus = "status  ";
  if (line.starts_with(kStatus)) {
    const auto said = line.substr(kStatus.size());
    return std::string(kStatus) + with(style_of_status(said), said);
  }
  const auto title = heading(line);
  if (title.empty()) return std::string(line);
  return with(kBold, title) + std::string(line.substr(title.size()));
}

}  // namespace turnwright::report
