#include "notation_words.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "base/say.hpp"

namespace turnwright::exchange::notated {
namespace {

constexpr std::size_t kMostMistakes = 100;  // in one answer
constexpr std::size_t kLongestShown = 40;   // bytes of the text in a message

bool blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
bool digit(char c) { return c >= '0' && c <= '9'; }
bool continues_character(char c) {
  return (static_cast<unsigned char>(c) & 0xc0) == 0x80;
}

// What belongs to the number behind it.
bool is_prefix(Word word) {
  constexpr std::array<std::string_view, 12> kPrefixes{
      "x", "×", "d", "Ø", "ø", "⌀", "ra", "rz", "r", "m", "±", "grind"};
  const std::string w = small(word);
  return std::find(kPrefixes.begin(), kPrefixes.end(), w) != kPrefixes.end() ||
         w == "+-" || w == "+/-";
}

std::string shown_word(Word word) {
  const Word begins = beginning(word, kLongestShown);
  return '"' + std::string(begins) + (begins.size() < word.size() ? "..\"" : "\"");
}

}  // namespace

void Mistakes::add(Word at, std::string expected, std::string got) {
  if (list_.size() == kMostMistakes) return;
  const auto before = text_.substr(0, static_cast<std::size_t>(at.data() - text_.data()));
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const auto begin = before.rfind('\n') + 1;  // 0 if there is none
  const auto column =
      std::count_if(before.begin() + static_cast<std::ptrdiff_t>(begin), before.end(),
                    [](char c) { return !continues_character(c); }) +
      1;
  list_.push_back({say("line {}, column {}", line, column),
                   got.empty() ? shown_word(at) : std::move(got), std::move(expected),
                   "notation"});
}

void Mistakes::throw_if_any() const {
  if (!list_.empty()) throw InputError("notation", list_);
}

std::size_t utf8_length(std::string_view text) {
  std::size_t i = 0;
  while (i < text.size()) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const std::size_t rest = lead < 0x80 ? 0 : lead < 0xe0 ? 1 : lead < 0xf0 ? 2 : 3;
    if ((lead >= 0x80 && lead < 0xc2) || lead > 0xf4 || i + rest >= text.size()) return i;
    for (std::size_t k = 1; k <= rest; ++k)
      if (!continues_character(text[i + k])) return i;
    const auto second = static_cast<unsigned char>(rest > 0 ? text[i + 1] : 0);
    const bool overlong =
        (lead == 0xe0 && second < 0xa0) || (lead == 0xf0 && second < 0x90);
    const bool beyond =
        (lead == 0xed && second > 0x9f) || (lead == 0xf4 && second > 0x8f);
    if (overlong || beyond) return i;
    i += rest + 1;
  }
  return i;
}

std::string_view beginning(std::string_view text, std::size_t most) {
  if (text.size() <= most) return text;
  while (most > 0 && continues_character(text[most])) --most;
  return text.substr(0, most);
}

std::vector<Word> statements(std::string_view text) {
  std::vector<Word> out;
  std::size_t begin = 0;
  bool quoted = false, after_colon = false;
  const auto end_at = [&](std::size_t end) {
    const Word s = trimmed(text.substr(begin, end - begin));
    if (!s.empty()) out.push_back(s);
    begin = end + 1;
    quoted = after_colon = false;
  };
  for (std::size_t i = text.rfind("\xef\xbb\xbf", 0) == 0 ? begin = 3 : 0;
       i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\n' || (c == ';' && !quoted)) {
      end_at(i);
    } else if (c == '"' && (quoted || after_colon)) {
      quoted = !quoted;  // "" closes and opens again
      after_colon = quoted || after_colon;
    } else if (!blank(c)) {
      after_colon = quoted || c == ':';
    }
  }
  end_at(text.size());
  return out;
}

std::vector<Word> words(Word statement) {
  std::vector<Word> out;
  bool joins = false;
  for (std::size_t i = 0; i < statement.size();) {
    if (blank(statement[i])) {
      ++i;
      continue;
    }
    const std::size_t begin = i;
    while (i < statement.size() && !blank(statement[i])) ++i;
    const Word word = statement.substr(begin, i - begin);
    if (joins && !is_prefix(word)) {
      const char* from = out.back().data();
      out.back() = {from, static_cast<std::size_t>(word.data() - from) + word.size()};
      joins = false;
    } else {
      out.push_back(word);
      joins = is_prefix(word);
    }
  }
  return out;
}

Word trimmed(Word s) {
  while (!s.empty() && blank(s.front())) s.remove_prefix(1);
  while (!s.empty() && blank(s.back())) s.remove_suffix(1);
  return s;
}

std::string small(Word s) {
  std::string out(s);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

bool same(Word word, std::string_view small_letters) {
  return small(word) == small_letters;
}

bool take(Word& word, std::initializer_list<std::string_view> beginnings) {
  for (const std::string_view b : beginnings) {
    if (word.size() < b.size() || small(word.substr(0, b.size())) != b) continue;
    word.remove_prefix(b.size());
    while (!word.empty() && blank(word.front())) word.remove_prefix(1);
    return true;
  }
  return false;
}

std::optional<double> take_number(Word& word) {
  constexpr std::size_t kLongest = 400;  // the smallest double has 327 places
  std::string digits;
  std::size_t n = 0;
  bool point = false;
  for (; n < word.size() && n < kLongest; ++n) {
    const bool mark = word[n] == '.' || (word[n] == ',' && n > 0);
    if (mark && !point && n + 1 < word.size() && digit(word[n + 1])) {
      point = true;
      digits += '.';
    } else if (digit(word[n])) {
      digits += word[n];
    } else {
      break;
    }
  }
  double x = 0;
  const auto end = digits.data() + digits.size();
  const auto read = std::from_chars(digits.data(), end, x, std::chars_format::fixed);
  if (read.ec != std::errc() || read.ptr != end || !std::isfinite(x)) return std::nullopt;
  word.remove_prefix(n);
  return x;
}

std::optional<double> take_signed_number(Word& word) {
  const bool minus = take(word, {"-", "−"});
  if (!minus) take(word, {"+"});
  const auto x = take_number(word);
  if (!x) return std::nullopt;
  return minus && *x != 0 ? -*x : *x;
}

std::optional<double> number(Word word) {
  const auto x = take_number(word);
  return word.empty() ? x : std::nullopt;
}

std::optional<std::vector<double>> product(Word word) {
  std::vector<double> factors;
  do {
    const auto x = take_number(word);
    if (!x) return std::nullopt;
    factors.push_back(*x);
  } while (take(word, {"x", "×"}));
  if (!word.empty()) return std::nullopt;
  return factors;
}

}  // namespace turnwright::exchange::notated
