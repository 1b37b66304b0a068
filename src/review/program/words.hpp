#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "parameters.hpp"

/// Blocks of a program as words and comments, whatever the control.
namespace turnwright::review {

/// Larger numbers are no words of any control.
inline constexpr double kLargestWord = 1e7;

/// "X12.5", "LIMS=2500", "X1=0", "DIAMON" (which has no value).
struct Word {
  std::string name;  ///< in capitals; of "X1=0" with its digit
  std::optional<double> value = {};
  bool point = false;     ///< whether the number has a point
  std::string text = {};  ///< as it stands
  std::size_t at = 0;     ///< where, in its line
  /// What a control reckons where no number stands: "#1", "[#1+2]", "-SIN[30]".
  std::string expression = {};
  /// Of a coordinate, "X=IC(-2)", "X=AC(5)"; otherwise as the mode says.
  enum class Meant { by_mode, absolute, incremental };
  Meant meant = Meant::by_mode;
};

/// "#1=[#2+3]", "#<depth>=2": a parameter and what becomes its value.
struct Assignment {
  std::string parameter, expression;
};

struct Block {
  std::vector<Word> words;
  std::vector<std::string> comments;         ///< without their brackets
  std::vector<Assignment> assignments = {};  ///< in their order
  bool deletable = false;                    ///< begins with "/"
  std::string rest = {};                     ///< what is not words: "CYCLE95(..)"

  const Word* find(std::string_view name) const;
  std::optional<double> value(std::string_view name) const;
};

/// The lines of a program, without the ends that part them.
std::vector<std::string_view> lines_of(std::string_view text);

/// Words of a line up to the first that is none, as a control writes them.
Block block_of(std::string_view line, Language language);

}  // namespace turnwright::review
