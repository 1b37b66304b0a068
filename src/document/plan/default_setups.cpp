#include "default_setups.hpp"

#include <algorithm>

#include "turnwright/base/errors.hpp"
#include "turnwright/base/language.hpp"
#include "turnwright/planning/prepare.hpp"

namespace turnwright::document {
namespace {

bool leaves_setups_open(const Variant& variant, const LoadedPart& loaded) {
  return !variant.document.contains("setups") && !loaded.plan.operations &&
         std::ranges::none_of(loaded.plan.milled,
                              [](const auto& m) { return m.given_setup.has_value(); });
}

}  // namespace

LoadedPart with_setups(Variant& variant, const Catalogue& catalogue,
                       const std::string& document) {
  auto loaded = load_variant(variant, catalogue, document);
  if (!leaves_setups_open(variant, loaded)) return loaded;
  const auto not_made = planning::not_made(loaded.plan).size();
  if (not_made == 0) return loaded;
  auto other = variant;
  const nlohmann::json setups = {{{"hold", "right"}}, {{"hold", "left"}}};
  other.document["setups"] = setups;
  try {
    auto turned = load_variant(other, catalogue, document);
    if (planning::not_made(turned.plan).size() >= not_made) return loaded;
    turned.assumed.push_back({"/setups", setups,
                              tr("hold right, then left: the other way round not every "
                                 "surface could be cut")});
    variant = std::move(other);
    return turned;
  } catch (const InputError&) {  // the chuck does not hold the part so
    return loaded;
  }
}

}  // namespace turnwright::document
