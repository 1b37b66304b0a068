#include "dxf_styles.hpp"

#include <cmath>
#include <optional>
#include <set>

#include "base/say.hpp"

namespace turnwright::exchange::dxf {
namespace {

constexpr double kOne = 1e-9;

// A negative factor is that of dimensions on the sheet alone.
void require_full_size(double factor, const std::string& place) {
  if (factor > 0 && std::abs(factor - 1) > kOne)
    refuse(place, say("dimensions that show {:g} times what is drawn (DIMLFAC)", factor),
           tr("a part drawn in full size, 1:1"));
}

// DIMLFAC among what a dimension changes of its style.
std::optional<double> own_factor(const Entity& dimension) {
  constexpr long kDimlfac = 144;
  bool next = false;
  Groups groups = dimension.groups();
  while (const auto g = groups.next()) {
    if (g->code == 1040 && next) return number(*g);
    next = g->code == 1070 && integer(*g) == kDimlfac;
  }
  return std::nullopt;
}

}  // namespace

void check_styles(const File& file, std::vector<Remark>& ignored) {
  std::set<std::string> told;
  bool dimensioned = false;
  for (const Entity& e : file.entities) {
    if (e.type != "DIMENSION") continue;
    dimensioned = true;
    const auto own = own_factor(e);
    if (own) require_full_size(*own, e.name());
    const auto name = capital(e.text_or(3, "STANDARD"));
    const auto style = file.styles.find(name);
    if (style == file.styles.end()) continue;
    if (!own) require_full_size(style->second.factor, e.name());
    const bool adds = style->second.limits || style->second.affixed;
    if (adds && told.insert(name).second)
      ignored.push_back(
          {name, say("The dimension style {} adds {} to its dimensions, "
                     "which is not read.",
                     name, style->second.limits ? tr("limits") : tr("a text"))});
  }
  const auto header = file.header.find("$DIMLFAC");
  if (dimensioned && header != file.header.end())
    require_full_size(number(header->second), "$DIMLFAC");
}

}  // namespace turnwright::exchange::dxf
