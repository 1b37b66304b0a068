#include "part21_lexer.hpp"

#include <charconv>

#include "base/say.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::exchange {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }
bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r') || c == '\0'; }
bool is_of_number(char c) {
  return is_digit(c) || c == '.' || c == '+' || c == '-' || c == 'E' || c == 'e';
}

Value text_value(ValueKind kind, std::string_view text) {
  Value v(kind, text.size());
  v.at = text.data();
  return v;
}

}  // namespace

void Part21Lexer::space() {
  for (; at_ < text_.size(); ++at_) {
    const char c = text_[at_];
    if (is_space(c)) continue;
    if (c != '/' && c != '\\') return;
    const auto rest = text_.substr(at_);
    if (rest.starts_with("\\N\\") || rest.starts_with("\\F\\")) {
      at_ += 2;
    } else if (rest.starts_with("/*")) {
      const auto end = text_.find("*/", at_ + 2);
      if (end == std::string_view::npos) refuse(tr("*/ at the end of this comment"));
      at_ = end + 1;
    } else {
      return;
    }
  }
}

char Part21Lexer::peek() {
  space();
  return ended() ? '\0' : text_[at_];
}

bool Part21Lexer::take(char c) {
  const bool comes = peek() == c && !ended();
  if (comes) ++at_;
  return comes;
}

void Part21Lexer::expect(char c, std::string_view where) {
  if (!take(c)) refuse(fmt::format("{} {}", c, translated(where)));
}

std::string_view Part21Lexer::keyword() {
  space();
  const auto begin = at_;
  if (!ended() && text_[at_] == '!') ++at_;  // a name that users have agreed upon
  const auto of_name = [](char c) {
    return is_letter(c) || is_digit(c) || c == '_' || c == '-';
  };
  if (ended() || !is_letter(text_[at_])) return at_ = begin, std::string_view();
  while (!ended() && of_name(text_[at_])) ++at_;
  return text_.substr(begin, at_ - begin);
}

Id Part21Lexer::id() {
  space();
  Id id = 0;
  const auto [end, error] =
      std::from_chars(text_.data() + at_, text_.data() + text_.size(), id);
  if (error != std::errc()) refuse(tr("the number of an instance behind #"));
  at_ = static_cast<std::size_t>(end - text_.data());
  return id;
}

Value Part21Lexer::scalar() {
  const char c = peek();
  if (is_digit(c) || c == '+' || c == '-') return number();
  if (c == '\'')
    return ++at_,
           text_value(ValueKind::text, quoted('\'', to_translate("a string that ends")));
  if (c == '"')
    return ++at_, text_value(ValueKind::binary,
                             quoted('"', to_translate("a binary value that ends")));
  if (c != '.') refuse(tr("a value"));
  if (at_ + 1 < text_.size() && is_digit(text_[at_ + 1])) return number();
  ++at_;
  const auto word = keyword();
  if (word.empty() || ended() || text_[at_] != '.') refuse(tr("an enumeration, .WORD."));
  return ++at_, text_value(ValueKind::enumeration, word);
}

Value Part21Lexer::number() {
  const auto begin = at_;
  bool whole = true;
  while (!ended() && is_of_number(text_[at_])) {
    const char c = text_[at_++];
    whole = whole && (is_digit(c) || c == '+' || c == '-');
  }
  auto digits = text_.substr(begin, at_ - begin);
  if (digits[0] == '+') digits.remove_prefix(1);
  const char *first = digits.data(), *last = first + digits.size();
  Value v(whole ? ValueKind::integer : ValueKind::real);
  auto [end, error] = whole ? std::from_chars(first, last, v.integer)
                            : std::from_chars(first, last, v.real);
  const bool tiny =
      error == std::errc::result_out_of_range && !whole &&
      (digits.find("E-") != digits.npos || digits.find("e-") != digits.npos);
  if (tiny) v.real = 0, error = {};
  if (error == std::errc() && end == last) return v;
  at_ = begin;
  refuse(whole ? tr("an integer of 64 bits") : tr("a finite number"));
}

std::string_view Part21Lexer::quoted(char mark, std::string_view what) {
  const auto begin = at_;
  for (;;) {
    const auto end = text_.find(mark, at_);
    if (end == std::string_view::npos) {
      at_ = begin - 1;
      refuse(tr(what));
    }
    at_ = end + 1;
    if (ended() || text_[at_] != mark) return text_.substr(begin, end - begin);
    ++at_;  // a doubled quote is a character of the string
  }
}

void Part21Lexer::skip_record() {
  while (!ended()) {
    const char c = text_[at_];
    if (c == ';') {
      ++at_;
      return;
    }
    const bool comment = text_.substr(at_).starts_with("/*");
    const auto end = c == '\'' ? text_.find('\'', at_ + 1)
                     : comment ? text_.find("*/", at_ + 2)
                               : at_;
    if (end == std::string_view::npos) {
      at_ = text_.size();
      return;
    }
    at_ = end + 1;
  }
}

std::string Part21Lexer::here() const {
  if (ended()) return tr("the end of the file");
  auto rest = text_.substr(at_, 20);
  rest = rest.substr(0, rest.find_first_of("\r\n"));
  return rest.empty() ? tr("the end of a line") : std::string(rest);
}

void Part21Lexer::refuse(std::string expected) const {
  throw SyntaxError{at_, here(), std::move(expected)};
}

}  // namespace turnwright::exchange
