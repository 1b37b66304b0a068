#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "flow.hpp"
#include "words.hpp"

/// Branches, calls and contours of Okuma's programs.
namespace turnwright::review {

/// GOTO N10; IF [..] N10, also with GOTO; CALL O100 Q2 LA=3; RTS; NOEX before variables.
/// Blocks and programs have numbers or names, NLAP1 and OSUB.
/// Source: [Okuma user task] in docs/bibliography.md.
class OkumaStatements {
 public:
  explicit OkumaStatements(const Flow& flow);

  /// Whether the flow's line is one of them; it has then been executed.
  /// @throws NotFollowed if it cannot be.
  bool direct(Flow& flow) const;

  /// Whether a line's word directs the flow, which a contour must not.
  static bool is_directing(std::string_view line);

  /// The line of the G80 that ends a contour's definition.
  std::optional<std::size_t> end_of_contour(std::size_t line) const;

 private:
  std::vector<std::size_t> ends_;  // lines with G80
};

/// The label that a word names: "N10", "NLAP1".
std::optional<std::string> label_in(const Block& block);

}  // namespace turnwright::review
