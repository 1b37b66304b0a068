#include "framing.hpp"

#include <algorithm>

namespace turnwright::service {
namespace {

constexpr unsigned kMostDigits = 16;  // of a number below 2^64

/// -1 if it is no hexadecimal digit.
int digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

/// A character of a token (RFC 9110, 5.6.2).
bool is_of_token(char c) {
  constexpr std::string_view kMarks = "!#$%&'*+-.^_`|~";
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
         kMarks.find(c) != std::string_view::npos;
}

bool is_control(char c) {
  const auto code = static_cast<unsigned char>(c);
  return (code < 32 && c != '\t') || code == 127;
}

bool is_blank(char c) { return c == ' ' || c == '\t'; }

}  // namespace

Framing Framing::of_length(std::uint64_t bytes) {
  Framing framing;
  framing.left_ = bytes;
  if (bytes == 0) framing.state_ = State::done;
  return framing;
}

Framing Framing::of_chunks(std::uint64_t most, std::size_t most_lines) {
  Framing framing;
  framing.chunked_ = true;
  framing.at_ = At::size;
  framing.most_ = most;
  framing.most_lines_ = most_lines;
  return framing;
}

Framing::Piece Framing::next(std::string_view bytes) {
  std::size_t at = 0;
  while (at < bytes.size() && state_ == State::more && at_ != At::content)
    at_ = after(bytes[at++]);
  if (state_ != State::more || at_ != At::content) return {{}, at};
  const auto size =
      static_cast<std::size_t>(std::min<std::uint64_t>(left_, bytes.size() - at));
  left_ -= size;
  if (left_ == 0 && chunked_)
    at_ = At::content_cr;
  else if (left_ == 0)
    state_ = State::done;
  return {bytes.substr(at, size), at + size};
}

Framing::At Framing::after(char c) {
  switch (at_) {
    case At::size:
      digits_ = 0;
      left_ = 0;
      return after_digit(c);
    case At::more_size:
      return digit(c) < 0 ? after_size(c) : after_digit(c);
    case At::blank:
      return c == ';'      ? At::extension
             : is_blank(c) ? line(c, At::blank, At::blank)
                           : fail(State::wrong);
    case At::extension:
      return line(c, At::extension, At::size_end);
    case At::size_end:
      return expect(c, '\n', left_ > 0 ? At::content : At::trailer);
    case At::content_cr:
      return expect(c, '\r', At::content_end);
    case At::content_end:
      return expect(c, '\n', At::size);
    case At::trailer:
      if (c == '\r') return At::last;
      [[fallthrough]];
    case At::trailer_name:
      if (c == ':' && at_ == At::trailer_name) return At::trailer_value;
      return is_of_token(c) ? line(c, At::trailer_name, At::trailer_name)
                            : fail(State::wrong);
    case At::trailer_value:
      return line(c, At::trailer_value, At::trailer_end);
    case At::trailer_end:
      return expect(c, '\n', At::trailer);
    case At::last:
      if (c == '\n') state_ = State::done;
      return c == '\n' ? At::content : fail(State::wrong);
    case At::content:
      break;
  }
  return at_;
}

Framing::At Framing::after_digit(char c) {
  const int value = digit(c);
  if (value < 0 || ++digits_ > kMostDigits) return fail(State::wrong);
  left_ = 16 * left_ + static_cast<std::uint64_t>(value);
  return At::more_size;
}

Framing::At Framing::after_size(char c) {
  if (c != '\r' && c != ';' && !is_blank(c)) return fail(State::wrong);
  if (left_ > most_) return fail(State::too_large);
  most_ -= left_;
  return c == '\r' ? At::size_end : c == ';' ? At::extension : At::blank;
}

/// The place behind a character of a line that is ignored.
Framing::At Framing::line(char c, At same, At end) {
  if (c == '\r') return end;
  if (is_control(c)) return fail(State::wrong);
  if (most_lines_ == 0) return fail(State::too_long);
  --most_lines_;
  return same;
}

Framing::At Framing::expect(char c, char wanted, At then) {
  return c == wanted ? then : fail(State::wrong);
}

Framing::At Framing::fail(State why) {
  state_ = why;
  return at_;
}

}  // namespace turnwright::service
