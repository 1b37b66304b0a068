#include "reference.hpp"

#include <algorithm>

#include "base/say.hpp"

namespace turnwright::document {
namespace {

constexpr std::size_t kListed = 12;  // ids that a message lists before "..."

}  // namespace

std::string expected_reference(const std::string& id,
                               const std::vector<std::string>& known,
                               const std::string& what) {
  const auto near = nearest(id, known);
  if (!near.empty()) return did_you_mean(what, near);
  std::string list;
  for (std::size_t i = 0; i < known.size() && i < kListed; ++i)
    list += (i > 0 ? ", \"" : "\"") + known[i] + '"';
  if (known.size() > kListed) list += ", ...";
  return list.empty() ? say("{}, which has none", what) : what + ": " + list;
}

std::string checked_reference(const Reader& value, const std::vector<std::string>& known,
                              const std::string& what) {
  auto id = value.as_text();
  const bool found = std::find(known.begin(), known.end(), id) != known.end();
  if (id.empty() || known.empty() || found) return id;
  const bool listed = value.problems().list.size() < Problems::kListed;
  value.problem(listed ? expected_reference(id, known, what) : "", "unknown-id");
  return id;
}

}  // namespace turnwright::document
