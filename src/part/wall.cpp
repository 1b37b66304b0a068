#include "turnwright/part/wall.hpp"

namespace turnwright::part {
namespace {

// Diameter of a list of elements beside z, on the side `towards` (+1: right); `beyond`
// where there is none.
template <class Element, class LeftEnd>
double diameter_mm(const std::vector<Element>& elements, const LeftEnd& left_end,
                   double z, double towards, double beyond) {
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const auto& e = elements[i];
    const double u = (z - left_end(i)) / e.length_mm;
    const double inwards = u + towards * 1e-9;
    const auto made = core(e);
    if (inwards > 0 && inwards < 1)
      return made.left_mm + (made.right_mm - made.left_mm) * u;
  }
  return beyond;
}

}  // namespace

Wall thinnest_wall(const Drawing& d) {
  std::vector<double> ends{0, length_mm(d)};
  for (std::size_t i = 0; i < d.outer.size(); ++i) ends.push_back(left_z_mm(d, i));
  for (std::size_t i = 0; i < d.inner.size(); ++i)
    for (const double u : {0.0, d.inner[i].length_mm})
      ends.push_back(inner_left_z_mm(d, i) + u);
  Wall wall;
  for (const double z : ends)
    for (const double side : {-1.0, 1.0}) {
      const double outer = diameter_mm(
          d.outer, [&](std::size_t i) { return left_z_mm(d, i); }, z, side, 0);
      const double inner = diameter_mm(
          d.inner, [&](std::size_t i) { return inner_left_z_mm(d, i); }, z, side,
          d.stock.inner_mm);
      if (outer > 0 && 1 - inner / outer < wall.share) wall = {z, 1 - inner / outer};
    }
  return wall;
}

}  // namespace turnwright::part
