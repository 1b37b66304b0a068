#pragma once
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "flow.hpp"

/// LinuxCNC's O words: subroutines, branches and loops.
namespace turnwright::review {

/// sub, endsub, return, call; if, elseif, else, endif; while, endwhile; do, while; repeat,
/// endrepeat; break and continue, each behind a label: o100, o<name>, o[#1].
class OWords {
 public:
  explicit OWords(const Flow& flow);

  /// Whether the flow's line is one of them; it has then been executed.
  /// @throws NotFollowed if it cannot be.
  bool direct(Flow& flow) const;

  /// The lines of a subroutine between its sub and its endsub, both included.
  std::optional<std::pair<std::size_t, std::size_t>> subroutine(double number) const;

 private:
  enum class Kind {
    sub,
    endsub,
    back,
    call,
    if_,
    elseif,
    else_,
    endif,
    while_,
    endwhile,
    do_,
    do_while,
    repeat,
    endrepeat,
    leave,
    go_on
  };
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  struct Line {
    std::size_t line = 0;
    std::string label;
    Kind kind = Kind::sub;
    std::string_view rest;  ///< behind the word
    /// Lines with the same label that belong together, as places in the list.
    std::size_t first = kNone, next = kNone, last = kNone;
  };

  static std::optional<Line> read(std::string_view text);
  void tie(std::size_t i);
  const Line& tied(std::size_t i) const;
  void after(Flow& flow, const Line& line) const { flow.go_to(line.line + 1); }

  void branch(Flow& flow, const Line& line) const;
  void loop(Flow& flow, const Line& line) const;
  void repeat(Flow& flow, const Line& line) const;
  void call(Flow& flow, const Line& line) const;
  void back(Flow& flow, const Line& line) const;
  void leave_loop(Flow& flow, const Line& line) const;

  std::vector<Line> all_;
  std::map<std::string, std::vector<std::size_t>> open_, begun_;
  std::map<std::string, std::size_t> subroutines_;
};

}  // namespace turnwright::review
