#include <algorithm>
#include <cmath>

#include "base/say.hpp"
#include "part_sections.hpp"
#include "turnwright/part/wall.hpp"

namespace turnwright::document {
namespace {

constexpr double kThin = 0.2;  // wall over radius: below it a ring ovalises

void check_hole(const Reader& list, const part::Drawing& d) {
  const auto items = list.as_items(0, d.inner.size());
  const auto hole = number_text(d.stock.inner_mm) + " mm";
  for (std::size_t i = 0; i < d.inner.size(); ++i) {
    const auto [low, high] = std::minmax(d.inner[i].left_mm, d.inner[i].right_mm);
    if (low < d.stock.inner_mm)
      items[i].problem(tr("a bore narrower than the tube's hole"),
                       say("diameters of at least {}", hole), "conflict");
    else if (high == d.stock.inner_mm)
      items[i].problem(tr("a bore that is the tube's hole"),
                       say("a diameter above {}, or no bore: nothing is cut there", hole),
                       "conflict");
  }
}

}  // namespace

bool sizes_were_read(const part::Drawing& d) {
  const auto sound = [](const auto& e) {
    return e.length_mm > 0 && e.left_mm > 0 && e.right_mm > 0;
  };
  return d.stock.outer_mm > 0 && !d.outer.empty() &&
         std::all_of(d.outer.begin(), d.outer.end(), sound) &&
         std::all_of(d.inner.begin(), d.inner.end(), sound);
}

void check_bores(Draft& draft) {
  const auto& d = draft.drawing();
  if (!sizes_were_read(d)) return;
  const auto list = draft.root.find("inner");
  double depth = 0;
  for (const auto& e : d.inner) depth += e.length_mm;
  if (!d.inner.empty()) check_hole(*list, d);
  if (depth > part::length_mm(d) * (1 + 1e-12)) {
    list->problem(
        say("bores of {} mm in all", number_text(depth)),
        say("at most the part's length, {} mm", number_text(part::length_mm(d))),
        "conflict");
    return;
  }
  const part::Wall wall = part::thinnest_wall(d);
  const auto in_the_hole = [&](const auto& e) {
    return std::min(e.left_mm, e.right_mm) <= d.stock.inner_mm;
  };
  // Of the stock, whose own check tells it.
  const bool told = d.inner.empty() && std::ranges::any_of(d.outer, in_the_hole);
  if (wall.share >= kThin - 1e-9 || told) return;
  const Reader at = d.inner.empty() ? draft.root.at("stock") : *list;
  at.problem(say("a wall of {} of the radius at z = {} mm",
                 number_text(std::round(1e4 * wall.share) / 1e4), number_text(wall.z_mm)),
             tr("a wall of at least 0.2 of the radius: thinner ones ovalise, which a "
                "beam does not show"),
             "conflict");
}

}  // namespace turnwright::document
