#include <algorithm>
#include <array>
#include <string_view>

#include "turnwright/document/part_plan.hpp"

namespace turnwright::document {
namespace {

constexpr std::array<std::string_view, 3> kElements{"arc", "groove", "thread"};
constexpr std::array<std::string_view, 1> kOperations{"fixed"};

template <std::size_t N>
void refuse_kinds(Reader root, std::string_view list,
                  const std::array<std::string_view, N>& kinds,
                  const std::string& expected) {
  const auto value = root.find(list);
  if (!value || !value->is_array()) return;
  for (const auto& item : value->as_items(0, value->json().size())) {
    if (!item.is_object() || !item.json().contains("kind")) continue;
    const auto& kind = item.json()["kind"];
    if (std::any_of(kinds.begin(), kinds.end(),
                    [&](std::string_view word) { return kind == word; }))
      item.problem_at("kind", expected, "unsupported");
  }
}

}  // namespace

void refuse_unsupported(const Reader& root) {
  refuse_kinds(root, "outer", kElements,
               "a kind this version can plan: \"cylinder\" or \"cone\"");
  refuse_kinds(root, "operations", kOperations,
               "a kind this version can plan: \"face\", \"rough\", \"finish\", "
               "\"bore-rough\" or \"bore-finish\"");
  refuse_kinds(root, "inner", kElements,
               "a kind this version can plan: \"cylinder\" or \"cone\"");
  Reader r = root;
  if (r.has("milling") && r.json()["milling"].is_array() && !r.json()["milling"].empty())
    r.problem_at("milling", "none: this version plans turning only", "unsupported");
}

}  // namespace turnwright::document
