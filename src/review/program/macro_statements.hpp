#pragma once
#include <cstddef>
#include <map>
#include <string_view>

#include "flow.hpp"

/// Branches and loops of Fanuc's custom macro B.
namespace turnwright::review {

/// GOTO n; IF [..] GOTO n; IF [..] THEN #i=..; WHILE [..] DO m .. END m.
class MacroStatements {
 public:
  explicit MacroStatements(const Flow& flow);

  /// Whether the flow's line is one of them; it has then been executed.
  /// @throws NotFollowed if it cannot be.
  bool direct(Flow& flow) const;

 private:
  void branch(Flow& flow, std::string_view rest) const;
  void go_to(Flow& flow, std::string_view number) const;
  std::size_t other_end(std::size_t line) const;

  std::map<std::size_t, std::size_t> ends_;  // of loops: of each line the other
};

}  // namespace turnwright::review
