#include "heading.hpp"

#include <algorithm>
#include <cctype>

#include "document/json/text_lines.hpp"

namespace turnwright::document {
namespace {

/// Without brackets that hold all of it.
std::string_view without_brackets(std::string_view s) {
  s = trimmed(s);
  const bool inside = (s.starts_with('[') && s.find(']') == s.size() - 1) ||
                      (s.starts_with('(') && s.find(')') == s.size() - 1);
  return inside ? trimmed(s.substr(1, s.size() - 2)) : s;
}

bool is_of_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
         static_cast<unsigned char>(c) >= 0x80;
}

bool means(std::string_view word, std::string_view known) {
  return known.ends_with('*') ? word.starts_with(known.substr(0, known.size() - 1))
                              : word == known;
}

}  // namespace

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> out;
  bool inside = false;
  for (const char c : text) {
    if (is_of_word(c) && !inside) out.emplace_back();
    inside = is_of_word(c);
    if (inside)
      out.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return out;
}

Heading heading(std::string_view name, bool (*is_unit)(std::string_view)) {
  constexpr std::string_view kBefore = " [(,:/_", kJoined = "[(";
  constexpr std::size_t kLongest = 200;
  name = trimmed(name);
  if (name.size() > kLongest) return {std::string(name), ""};
  for (std::size_t at = 1; at < name.size(); ++at) {
    if (kBefore.find(name[at]) == kBefore.npos) continue;
    const std::size_t from = at + (kJoined.find(name[at]) == kJoined.npos ? 1 : 0);
    const std::string_view unit = without_brackets(name.substr(from));
    if (!unit.empty() && is_unit(unit))
      return {std::string(trimmed(name.substr(0, at))), std::string(unit)};
  }
  return {std::string(name), ""};
}

const Quantity* quantity_named(std::string_view heading,
                               const std::vector<Quantity>& quantities) {
  const auto words = words_of(heading);
  const auto found = std::ranges::find_if(quantities, [&](const Quantity& q) {
    return std::ranges::any_of(q.words, [&](std::string_view known) {
      return std::ranges::any_of(
          words, [&](const std::string& word) { return means(word, known); });
    });
  });
  return found == quantities.end() ? nullptr : &*found;
}

}  // namespace turnwright::document
