#pragma once
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

#include "turnwright/exchange/part21.hpp"

namespace turnwright::exchange {

/// What the reader met instead of what it looked for; becomes a Problem with its line.
struct SyntaxError {
  std::size_t at = 0;
  std::string got, expected;
};

/// The tokens of an exchange file, taken one by one from the text.
class Part21Lexer {
 public:
  explicit Part21Lexer(std::string_view text) : text_(text) {}

  std::size_t at() const { return at_; }
  bool ended() const { return at_ >= text_.size(); }
  /// Passes over white space, comments and print control directives (\N\, \F\).
  /// @throws SyntaxError at a comment that does not end.
  void space();
  /// Next character after space; 0 at the end.
  char peek();
  /// Takes `c` if it comes next.
  bool take(char c);
  void expect(char c, std::string_view where);
  /// Letters, digits, _ and - from here: an entity's name or a section's keyword; "" if
  /// none begins here.
  std::string_view keyword();
  /// After #.
  Id id();
  /// A number, string, enumeration or binary value.
  Value scalar();
  /// To behind the next ; that is in no string or comment, or to the end.
  void skip_record();
  void skip(std::size_t bytes) { at_ += bytes; }

  /// What stands here, for a message: at most 20 bytes.
  std::string here() const;
  [[noreturn]] void refuse(std::string expected) const;

 private:
  Value number();
  /// From behind the opening mark to before the closing one, which is taken too.
  std::string_view quoted(char mark, std::string_view what);
  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace turnwright::exchange
