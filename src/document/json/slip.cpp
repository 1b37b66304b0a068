#include "slip.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/say.hpp"

namespace turnwright::document {
namespace {

bool digit(char c) { return c >= '0' && c <= '9'; }
bool letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

constexpr std::size_t kShownWord = 40;  // of a word

// The characters around a place for which a test holds.
template <class Test>
std::string_view around(std::string_view text, std::size_t at, const Test& test) {
  std::size_t from = at, to = at;
  while (from > 0 && test(text[from - 1])) --from;
  while (to < text.size() && test(text[to])) ++to;
  return text.substr(from, to - from).substr(0, kShownWord);
}

// The last character before a place that is no blank; 0 if there is none.
char before(std::string_view text, std::size_t at) {
  while (at > 0 && blank(text[at - 1])) --at;
  return at > 0 ? text[at - 1] : '\0';
}

// "1,6" where a member's value goes on behind a comma.
std::optional<Slip> decimal_comma(std::string_view text, std::size_t last) {
  const auto word = around(
      text, last, [](char c) { return digit(c) || c == ',' || c == '.' || c == '-'; });
  const auto comma = word.find(',');
  if (comma == word.npos || comma == 0 || comma + 1 >= word.size() ||
      word.find(',', comma + 1) < word.size() - 1 || !digit(word[comma - 1]) ||
      !digit(word[comma + 1]))
    return std::nullopt;
  const auto number = word.substr(0, word.find(',', comma + 1));
  std::string point(number);
  point[comma] = '.';
  return Slip{std::string(number), say("{}, with a decimal point", point)};
}

}  // namespace

std::optional<Slip> usual_slip(std::string_view text, std::size_t bytes_read,
                               std::string_view reason) {
  if (bytes_read == 0 || bytes_read > text.size()) return std::nullopt;
  const std::size_t last = bytes_read - 1;
  const char c = text[last];
  const char next = bytes_read < text.size() ? text[bytes_read] : '\0';
  const auto says = [&](std::string_view words) {
    return reason.find(words) != reason.npos;
  };
  if (says("in object key") && digit(c))
    if (auto slip = decimal_comma(text, last)) return slip;
  if ((c == '}' || c == ']') && before(text, last) == ',')
    return Slip{say("a comma before {}", c), tr("no comma behind the last one")};
  if (c == '/' && (next == '/' || next == '*'))
    return Slip{fmt::format("/{}", next), tr("no comment: JSON has none")};
  if (c == '#') return Slip{"#", tr("no comment: JSON has none")};
  if (c == '\'') return Slip{"'", tr("double quotes")};
  if (c == ';' || c == '=')
    return Slip{std::string(1, c),
                c == ';' ? tr("a comma between members") : tr("a colon")};
  for (const auto& [word, meant] :
       {std::pair{"True", "true"}, {"False", "false"}, {"None", "null"}})
    if (around(text, last, letter) == word) return Slip{word, meant};
  if ((c == '+' || c == '.') && digit(next)) {
    const auto word = around(
        text, last, [](char x) { return digit(x) || x == '+' || x == '-' || x == '.'; });
    const auto digits =
        word.substr(std::min(word.find_first_of(".0123456789"), word.size()));
    return Slip{std::string(word),
                fmt::format("{}{}{}", word[0] == '-' ? "-" : "",
                            digits.starts_with('.') ? "0" : "", digits)};
  }
  if (says("in object key") && letter(c)) {
    const auto word = around(text, last, [](char x) { return letter(x) || digit(x); });
    return Slip{std::string(word), say("\"{}\", in double quotes", word)};
  }
  if (says("unexpected number literal")) {
    const auto word = around(text, last, [](char x) { return digit(x) || x == '.'; });
    if (word.size() > 1 && word[0] == '0' && digit(word[1]))
      return Slip{std::string(word), tr("no zero before the other digits")};
  }
  const bool another = says("unexpected string literal") ||
                       says("unexpected number literal") || says("unexpected '{'") ||
                       says("unexpected '['");
  if (another && (says("expected '}'") || says("expected ']'")))
    return Slip{tr("two members or values side by side"), tr("a comma between them")};
  return std::nullopt;
}

}  // namespace turnwright::document
