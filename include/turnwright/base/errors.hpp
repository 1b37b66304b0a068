#pragma once
#include <stdexcept>
#include <string>
#include <vector>

namespace turnwright {

/// One thing wrong with a document, told so that the reader can find and mend it.
struct Problem {
  std::string pointer;   ///< JSON pointer into the document, "" for the whole of it
  std::string got;       ///< what stands there, as text, with unit where it has one
  std::string expected;  ///< what is wanted, with unit and limits
  std::string code;      ///< machine-readable kind: "type", "range", "unknown-key", ...
};

/// A document that cannot be read: all its problems, not only the first.
class InputError : public std::runtime_error {
 public:
  /// @param document  name of the file or request, shown before every problem.
  InputError(std::string document, std::vector<Problem> problems);
  const std::vector<Problem>& problems() const noexcept { return problems_; }
  const std::string& document() const noexcept { return document_; }

 private:
  std::string document_;
  std::vector<Problem> problems_;
};

/// A model asked outside the range it was made for (a hard limit).
class ModelRangeError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace turnwright
