#include "turnwright/base/errors.hpp"

#include <utility>

namespace turnwright {
namespace {

std::string list(const std::string& document, const std::vector<Problem>& problems) {
  std::string text;
  for (const auto& p : problems) {
    if (!text.empty()) text += '\n';
    text += document + ": " + (p.pointer.empty() ? "document" : p.pointer) + ": got " +
            p.got + ", expected " + p.expected;
  }
  return text;
}

}  // namespace

InputError::InputError(std::string document, std::vector<Problem> problems)
    : std::runtime_error(list(document, problems)),
      document_(std::move(document)),
      problems_(std::move(problems)) {}

}  // namespace turnwright
