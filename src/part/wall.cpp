#include "turnwright/part/wall.hpp"

#include <algorithm>

namespace turnwright::part {
namespace {

// Diameters of an element as it is made: the core of a cut, or its blank.
struct Beside {
  double core_mm = 0, blank_mm = 0;
};

// Of a list of elements beside z, on the side `towards` (+1: right); `beyond` where there
// is none.  Only a short groove has a blank of its own.
template <class Element>
Beside beside(const std::vector<Element>& elements,
              const std::vector<double>& left_ends_mm, double z, double towards,
              double beyond, double short_mm) {
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const auto& e = elements[i];
    const double u = (z - left_ends_mm[i]) / e.length_mm;
    const double inwards = u + towards * 1e-9;
    if (!(inwards > 0 && inwards < 1)) continue;
    const auto at = [&](double left, double right) { return left + (right - left) * u; };
    const auto made = core(e);
    const double core_mm = at(made.left_mm, made.right_mm);
    const bool borne = is_groove(e) && e.length_mm <= short_mm;
    return {core_mm, borne ? at(e.left_mm, e.right_mm) : core_mm};
  }
  return {beyond, beyond};
}

}  // namespace

Wall thinnest_wall(const Drawing& d) {
  std::vector<double> ends{0, length_mm(d)};
  const auto outer_mm = left_ends_mm(d), inner_mm = inner_left_ends_mm(d);
  ends.insert(ends.end(), outer_mm.begin(), outer_mm.end());
  for (std::size_t i = 0; i < d.inner.size(); ++i)
    for (const double u : {0.0, d.inner[i].length_mm}) ends.push_back(inner_mm[i] + u);
  double widest = 0;
  for (const auto& e : d.outer) widest = std::max({widest, e.left_mm, e.right_mm});
  const double short_mm = kBorneLength * widest / 2;
  Wall wall;
  for (const double z : ends)
    for (const double side : {-1.0, 1.0}) {
      const auto outer = beside(d.outer, outer_mm, z, side, 0, short_mm);
      const auto inner = beside(d.inner, inner_mm, z, side, d.stock.inner_mm, short_mm);
      if (!(outer.core_mm > 0)) continue;
      double share = 1 - inner.core_mm / outer.core_mm;
      if (share >= kBorneWall) share = 1 - inner.blank_mm / outer.blank_mm;
      if (share < wall.share) wall = {z, share};
    }
  return wall;
}

}  // namespace turnwright::part
