#pragma once
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace turnwright {

/// One error in a document, described so that its author can find and correct it.
struct Problem {
  std::string pointer;   ///< JSON pointer into the document, "" for the whole of it
  std::string got;       ///< the value in the document, as text, with its unit if any
  std::string expected;  ///< the values that are allowed, with unit and limits
  std::string code;      ///< machine-readable kind: "type", "range", "unknown-key", ...
};

/// Text with its control characters written as JSON does (\u001b), so that a terminal shows
/// them instead of obeying them.
std::string visible(std::string_view text);

/// Thrown for a document that cannot be read; lists all its problems, not only the first.
class InputError : public std::runtime_error {
 public:
  /// what() has a line for each problem, all of it visible().
  /// @param document  name of the file or request, shown before every problem.
  InputError(std::string document, std::vector<Problem> problems);
  const std::vector<Problem>& problems() const noexcept { return problems_; }
  const std::string& document() const noexcept { return document_; }

 private:
  std::string document_;
  std::vector<Problem> problems_;
};

/// Thrown when a model is used outside the range for which it holds.
class ModelRangeError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace turnwright
