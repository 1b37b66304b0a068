#pragma once
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "parameters.hpp"

/// The order in which a control executes the lines of a program.
namespace turnwright::review {

/// A number as a label.
std::string label_of(double number);

/// Where the programs and the labelled blocks of a text begin.  Programs begin with "O1234"
/// or ":1234", of Okuma also "OSUB", of Siemens with "%_N_SHAFT_MPF" or "PROC SHAFT"; blocks have a number,
/// "N10", of Okuma and Siemens also a name, "NLAP1" and "MARK:".  Numbers are names without zeros in front.
class Labels {
 public:
  Labels(const std::vector<std::string_view>& lines, Language language);

  std::optional<std::size_t> program(const std::string& name) const;
  /// The first line that bears a label between two lines, or the last.
  std::optional<std::size_t> block(const std::string& label, std::size_t from,
                                   std::size_t to) const;
  std::optional<std::size_t> last_block(const std::string& label, std::size_t from,
                                        std::size_t to) const;
  /// The end of the program that begins in a line.
  std::size_t end_of_program(std::size_t begin) const;
  /// The end of the program that is executed: the first, or what stands before it.
  std::size_t end_of_first() const { return end_of_first_; }

 private:
  void begin(const std::string& name, std::size_t line, bool blocks_before);

  std::map<std::string, std::size_t> programs_;
  std::vector<std::size_t> begins_;
  std::vector<std::pair<std::string, std::size_t>> blocks_;  // sorted
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
  std::size_t depth() const {
    return calls_.size();
  }  ///< of calls, 1 in the first program
  const std::vector<std::string_view>& lines() const { return lines_; }

  /// The line that bears a block number, of this program: the next one, else the first.
  std::optional<std::size_t> block(double N) const { return block(label_of(N)); }
  std::optional<std::size_t> block(const std::string& label) const;
  /// The next line with a label, and the one before.
  std::optional<std::size_t> block_ahead(const std::string& label) const;
  std::optional<std::size_t> block_behind(const std::string& label) const;
  std::optional<std::size_t> block_between(const std::string& label, std::size_t from,
                                           std::size_t to) const {
    return labels_.block(label, from, to);
  }
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
  /// A program with variables of its own, whose first lines the caller may have read; false
  /// if it is called no times.
  bool call_named(const std::string& name, double times);
  /// Lines of this program, both included, some times.
  void repeat(std::size_t first, std::size_t last, double times);
  /// Back behind the call, or to its beginning if it has times left; false in the first
  /// program.
  bool leave(std::optional<double> N = {});
  /// The same from within sections that are repeated.
  bool leave_program(std::optional<double> N = {});

  bool has_program(double number) const { return program(label_of(number)).has_value(); }
  std::optional<std::size_t> program(const std::string& name) const {
    return labels_.program(name);
  }
  std::size_t end_of_program(std::size_t begin) const {
    return labels_.end_of_program(begin);
  }
  void go_to_begin() { at_ = calls_.back().begin; }

  /// Times that a loop has left, by its line, in this call.
  std::map<std::size_t, long>& loops() { return calls_.back().loops; }

  /// Whether the condition in brackets at the front of a text holds, and what follows it.
  /// One that the program does not tell counts as false, and is a doubt.
  std::pair<bool, std::string_view> holds(std::string_view text);
  /// The same of a text that is a condition.
  bool holds_all(std::string_view condition);
  void doubt(const NotFollowed& why) { doubt_ = why.what(); }
  /// Why the last line could not be followed; none: it could.
  std::optional<std::string> take_doubt() { return std::exchange(doubt_, {}); }

 private:
  struct Call {
    std::size_t begin = 0, end = 0;  ///< of its program
    std::size_t from = 0, back = 0;  ///< its first line, the one after it
    std::size_t stop = 0;            ///< behind its last line
    bool section = false;            ///< lines of the same program
    long times = 1;
    bool own_variables = false;
    std::map<std::size_t, long> loops = {};
  };
  void push(Call call, double times);
  bool not_in_doubt(const std::function<bool()>& condition);

  const std::vector<std::string_view>& lines_;
  Labels labels_;
  std::vector<Call> calls_;
  std::size_t at_ = 0, line_ = 0;
  std::size_t executed_ = 0, most_ = 0;
  std::optional<std::string> doubt_;
};

/// What stands behind a block's number, without comments and blanks around it.
std::string_view statement_of(std::string_view line);
/// The same of Siemens, whose comments begin with ";" and whose blocks may have a label.
std::string_view siemens_statement_of(std::string_view line);
/// The same of Okuma, whose blocks may have a name and whose variables NOEX before them.
std::string_view okuma_statement_of(std::string_view line);
/// Whether a line is the name of a file as Okuma's controls send it: "$SHAFT.MIN%".
bool names_okuma_file(std::string_view line);
/// The label that stands at the front of a text: "N10" and "O10" as the number, of Okuma
/// names without their first letter.
std::string label_at_front(std::string_view text, Language language);
/// The name at the front of a text, small, and what follows it: letters, digits and "_".
std::pair<std::string, std::string_view> name_at_front(std::string_view text);
/// The word of letters at the front of a text, in capitals, and what follows it.
std::pair<std::string, std::string_view> keyword_of(std::string_view text);

}  // namespace turnwright::review
