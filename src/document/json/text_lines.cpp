#include "text_lines.hpp"

#include <algorithm>

#include "base/say.hpp"

namespace turnwright::document {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

std::vector<TextLine> lines_of_text(std::string_view text) {
  std::vector<TextLine> lines;
  for (std::size_t number = 1;; ++number) {
    const auto end = text.find('\n');
    lines.push_back({number, text.substr(0, end)});
    if (end == text.npos) return lines;
    text.remove_prefix(end + 1);
  }
}

}  // namespace

std::vector<TextLine> text_lines(const Reader& value, const char* form) {
  std::vector<TextLine> lines;
  if (value.broken()) return lines;
  if (value.is_text()) {
    lines = lines_of_text(value.json().get_ref<const std::string&>());
  } else if (value.is_array()) {
    for (const auto& item : value.json()) {
      if (!item.is_string()) {
        value.problem(tr(form), "type");
        return {};
      }
      lines.push_back({lines.size() + 1, item.get_ref<const std::string&>()});
    }
  } else {
    value.problem(tr(form), "type");
  }
  if (!lines.empty() && lines[0].text.starts_with(kByteOrderMark))
    lines[0].text.remove_prefix(kByteOrderMark.size());
  for (TextLine& line : lines)
    if (line.text.ends_with('\r')) line.text.remove_suffix(1);
  return lines;
}

bool are_text(const Reader& value, const std::vector<TextLine>& lines, const char* form) {
  const auto control = [](char c) {
    return (static_cast<unsigned char>(c) < ' ' && c != '\t') || c == '\x7f';
  };
  for (const TextLine& line : lines) {
    const auto at = std::ranges::find_if(line.text, control);
    if (at == line.text.end()) continue;
    value.problems().add({line_pointer(value, line.number),
                          say("the control character {} in column {}",
                              static_cast<int>(*at), at - line.text.begin() + 1),
                          tr(form), "type"});
    return false;
  }
  return true;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t";
  const auto first = text.find_first_not_of(kBlank);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::string line_pointer(const Reader& value, std::size_t number) {
  return value.pointer() + "#line " + std::to_string(number);
}

}  // namespace turnwright::document
