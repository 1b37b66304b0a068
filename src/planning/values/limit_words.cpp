#include "turnwright/planning/limit_words.hpp"

#include <string_view>
#include <utility>

#include "base/say.hpp"

namespace turnwright::planning {

std::string limit_words(const std::string& name) {
  if (auto whole = tr(name); whole != name) return whole;
  constexpr std::string_view kCost = "cost ";
  if (name.starts_with(kCost)) return say("cost {}", name.substr(kCost.size()));
  const auto parts = [&](const std::string& between) {
    const auto at = name.rfind(between);
    return at == std::string::npos
               ? std::pair<std::string, std::string>()
               : std::pair(name.substr(0, at), name.substr(at + between.size()));
  };
  if (const auto [what, whom] = parts(" of "); !what.empty())
    return say("{} of {}", limit_words(what), whom);
  if (const auto [what, setup] = parts(" in setup "); !what.empty())
    return say("{} in {}", tr(what), say("setup {}", setup));
  const auto [id, kind] = parts(" ");
  return id.empty() ? name : id + " " + tr(kind);
}

}  // namespace turnwright::planning
