#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "turnwright/base/errors.hpp"

/// The words of a notation and what is wrong with them.
namespace turnwright::exchange::notated {

/// A part of the text; its place is told by where it points to.
using Word = std::string_view;

inline bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// All mistakes of one text.
/// Units in which a text gives lengths and roughness, by their size and name.
struct Units {
  double mm = 1, um = 1;
  const char *length = "mm", *roughness = "um";
};

class Mistakes {
 public:
  explicit Mistakes(std::string_view text) : text_(text) {}
  /// Units of the text, in which it is told what is too large.
  Units units = {};
  /// @param at  part of the text; shown as what came unless `got` says it.
  void add(Word at, std::string expected, std::string got = "");
  bool none() const { return list_.empty(); }
  /// @throws InputError with all that were added.
  void throw_if_any() const;

 private:
  std::string_view text_;
  std::vector<Problem> list_;
};

/// Length of the part of the text that is UTF-8.
std::size_t utf8_length(std::string_view text);
/// The beginning of a text of UTF-8, at most so many bytes of whole characters.
std::string_view beginning(std::string_view text, std::size_t most);

/// The statements of a text, without blanks at their ends; empty ones are left out.  A ';'
/// between the quotation marks of a title is none.
std::vector<Word> statements(std::string_view text);

/// The words of a statement.  A letter that stands before its number is one word with it:
/// "x 40", "Ra 1.6", "Ø 50".
std::vector<Word> words(Word statement);

Word trimmed(Word s);
/// Small letters for A to Z.
std::string small(Word s);
bool same(Word word, std::string_view small_letters);

/// Takes one of the beginnings from the word, letters in any case, with blanks behind it.
bool take(Word& word, std::initializer_list<std::string_view> beginnings);
/// Takes an unsigned number, "40", "0.8", "50,5", or one with a sign before it.
std::optional<double> take_number(Word& word);
std::optional<double> take_signed_number(Word& word);
/// The word as an unsigned number to its end.
std::optional<double> number(Word word);
/// Numbers with x or × between them, to the end of the word.
std::optional<std::vector<double>> product(Word word);

}  // namespace turnwright::exchange::notated
