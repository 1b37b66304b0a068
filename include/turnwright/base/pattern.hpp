#pragma once
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace turnwright {

/// A regular expression of ECMAScript.  std::regex is named in one source file alone: every
/// file that names it takes three seconds longer to compile.  For short texts: std::regex
/// recurses once for each character.
class Pattern {
 public:
  /// What the whole expression matched, then what each of its groups did; "" of a group that
  /// took no part.
  using Groups = std::vector<std::string>;
  enum class Case { as_written, any };

  /// @throws std::regex_error  `expression` is not one.
  explicit Pattern(const std::string& expression, Case letters = Case::as_written);

  /// @param text  matched from its first to its last character.
  std::optional<Groups> match(std::string_view text) const;
  /// The first place in `text` that matches.
  std::optional<Groups> find_in(std::string_view text) const;
  /// All places in `text` that match, from the left, none overlapping another.
  std::vector<Groups> all_in(std::string_view text) const;

 private:
  struct Compiled;
  std::shared_ptr<const Compiled> compiled_;
};

}  // namespace turnwright
