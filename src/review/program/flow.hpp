#pragma once
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "parameters.hpp"

/// The order in which a control executes the lines of a program.
namespace turnwright::review {

/// Where the programs and the numbered blocks of a text begin.
class Labels {
 public:
  explicit Labels(const std::vector<std::string_view>& lines);

  std::optional<std::size_t> program(double number) const;
  /// The line of a block number between two lines.
  std::optional<std::size_t> block(double N, std::size_t from, std::size_t to) const;
  /// The end of the program that begins in a line.
  std::size_t end_of_program(std::size_t begin) const;
  /// The end of the program that is executed: the first, or what stands before it.
  std::size_t end_of_first() const { return end_of_first_; }

 private:
  std::map<double, std::size_t> programs_;
  std::vector<std::size_t> begins_;
  std::vector<std::pair<double, std::size_t>> blocks_;  // N and line, sorted
  std::size_t end_of_first_ = 0, end_ = 0;
};

/// The next line, and the subprograms that lines call.  A text holds one program, or
/// several that begin with a line "O1234", of which the first is executed.
class Flow {
 public:
  Flow(const std::vector<std::string_view>& lines, gcode::Control control);

  Parameters parameters;

  /// The line that is executed next, from 0; none at the end of the first program, and
  /// where more lines would be executed than are followed.
  std::optional<std::size_t> next();
  /// Whether there are more lines than are followed; counts one.
  bool spent() { return ++executed_ > most_; }
  bool endless() const { return executed_ > most_; }

  std::size_t line() const { return line_; }
  const std::vector<std::string_view>& lines() const { return lines_; }

  /// The line that bears a block number, of this program: the next one, else the first.
  std::optional<std::size_t> block(double N) const;
  /// @throws NotFollowed if there is none.
  std::size_t block_or_throw(double N) const;
  void go_to(std::size_t line) { at_ = line; }

  /// Calls the program "O1234" some times (M98), the blocks from a number to M99 (M97), or
  /// a program with variables of its own (G65).
  /// @throws NotFollowed if it is not in the text, or more than ten calls deep.
  void call_program(double number, double times);
  void call_blocks(double N, double times);
  void call_macro(double number, double times, const std::map<int, double>& arguments);
  /// The same of the lines behind one, whose end `leave` tells.
  void enter(std::size_t line, const std::map<int, double>& arguments);
  /// Back behind the call, or to its beginning if it has times left; false in the first
  /// program.
  bool leave(std::optional<double> N = {});

  bool has_program(double number) const { return labels_.program(number).has_value(); }

  /// Times that a loop has left, by its line, in this call.
  std::map<std::size_t, long>& loops() { return calls_.back().loops; }

  /// Whether the condition in brackets at the front of a text holds, and what follows it.
  /// One that the program does not tell counts as false, and is a doubt.
  std::pair<bool, std::string_view> holds(std::string_view text);
  void doubt(const NotFollowed& why) { doubt_ = why.what(); }
  /// Why the last line could not be followed; none: it could.
  std::optional<std::string> take_doubt() { return std::exchange(doubt_, {}); }

 private:
  struct Call {
    std::size_t begin = 0, end = 0;  ///< of its program
    std::size_t from = 0, back = 0;  ///< its first line, the one after it
    long times = 1;
    bool own_variables = false;
    std::map<std::size_t, long> loops = {};
  };
  void push(Call call, double times);

  const std::vector<std::string_view>& lines_;
  Labels labels_;
  std::vector<Call> calls_;
  std::size_t at_ = 0, line_ = 0;
  std::size_t executed_ = 0, most_ = 0;
  std::optional<std::string> doubt_;
};

/// What stands behind a block's number, without comments and blanks around it.
std::string_view statement_of(std::string_view line);
/// The word of letters at the front of a text, in capitals, and what follows it.
std::pair<std::string, std::string_view> keyword_of(std::string_view text);

}  // namespace turnwright::review
