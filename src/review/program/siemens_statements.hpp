#pragma once
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "flow.hpp"

/// Declarations, branches, loops and calls of Siemens' programs.
namespace turnwright::review {

/// DEF of REAL, INT and BOOL, also of arrays; IF .. ELSE .. ENDIF; WHILE, FOR, LOOP and
/// REPEAT .. UNTIL; GOTO, GOTOF, GOTOB and GOTOS, also behind IF; REPEAT and REPEATB of
/// labelled lines; calls by name with values, by L123, by CALL, each with P; RET and M17.
/// Source: [Siemens PGA] in docs/bibliography.md.
class SiemensStatements {
 public:
  explicit SiemensStatements(const Flow& flow);

  /// Whether the flow's line is one of them; it has then been executed.
  /// @throws NotFollowed if it cannot be.
  bool direct(Flow& flow) const;

  /// Whether a line's word directs the flow, which a contour must not.
  static bool is_directing(std::string_view line);

  /// The first and last lines of a contour: a subprogram, "NAME", or what stands between
  /// two labels of this program, "FIRST:LAST".
  static std::optional<std::pair<std::size_t, std::size_t>> contour(
      const Flow& flow, std::string_view name);

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  /// A line of a branch or loop, and those that belong to it.
  struct Part {
    std::string word;
    std::size_t first = kNone, next = kNone, last = kNone;
  };

  void tie(std::size_t line, const std::string& word);
  const Part& tied(std::size_t line) const;
  void branch(Flow& flow, std::string_view rest) const;
  void loop(Flow& flow, const std::string& word, std::string_view rest) const;
  void count(Flow& flow, std::string_view rest, bool begins) const;

  std::map<std::size_t, Part> parts_;
  std::vector<std::size_t> open_;
};

/// The text of each value between commas, brackets and quotes closed: of "(1,\"A,B\",F(2))".
/// @throws NotFollowed if the brackets are not closed.
std::vector<std::string> texts_of_arguments(std::string_view bracketed);

}  // namespace turnwright::review
