#include "setup_body.hpp"

#include <algorithm>

#include "positions.hpp"

namespace turnwright::planning {

SetupBody::SetupBody(const PreparedPart& p, std::size_t s, Clamping clamping,
                     const Finished& finished)
    : part_(&p),
      root_z_(root_z_mm(p, s, clamping)),
      sign_(holds_left(p, s) ? 1 : -1),
      length_(sign_ * (free_z_mm(p, s) - root_z_)) {
  const auto& d = p.drawing;
  const double far = 1e9;
  for (std::size_t i = 0; i < d.outer.size(); ++i) {
    const double z0 = part::left_z_mm(d, i);
    const auto& e = d.outer[i];
    const bool turned = finished.outer[i] && !e.as_stock;
    const double stock = part::stock_of(d, i).least_mm;
    const auto made = turned ? part::core(e) : part::Ends{stock, stock};
    outer_.push_back({z0, z0 + e.length_mm, made.left_mm, made.right_mm});
  }
  const double L = part::length_mm(d);
  const double left = part::stock_between(d.stock, -far, 0).least_mm,
               right = part::stock_between(d.stock, L, far).least_mm;
  outer_.push_back({-far, 0, left, left});
  outer_.push_back({L, far, right, right});
  const double hole = d.stock.inner_mm;
  for (std::size_t i = 0; i < d.inner.size(); ++i) {
    const double z0 = part::inner_left_z_mm(d, i);
    const auto& e = d.inner[i];
    const double drilled = hole_mm(p, i);  // and from the start: no stiffer
    const auto made = finished.inner[i] ? part::core(e) : part::Ends{drilled, drilled};
    inner_.push_back({z0, z0 + e.length_mm, made.left_mm, made.right_mm});
  }
  inner_.push_back({-far, far, hole, hole});  // where no element is
}

part::Shaft SetupBody::shaft(const std::vector<Zone>& outer,
                             const std::vector<Zone>& inner) const {
  const double low = std::min(root_z_, root_z_ + sign_ * length_);
  std::vector<double> ends{low, low + length_};
  for (const auto* zones : {&outer, &inner})
    for (const auto& zone : *zones)
      for (const double z : {zone.z0, zone.z1})
        if (z > ends[0] && z < ends[1]) ends.push_back(z);
  std::sort(ends.begin(), ends.end());
  // The first zone that contains a position counts; elements come before the stock beside
  // them.
  const auto zone_at = [](const std::vector<Zone>& zones, double z) {
    return *std::find_if(zones.begin(), zones.end(),
                         [&](const Zone& zone) { return zone.z0 <= z && z <= zone.z1; });
  };
  const auto diameter = [](const Zone& zone, double z) {
    return zone.d0 + (zone.d1 - zone.d0) * (z - zone.z0) / (zone.z1 - zone.z0);
  };
  const double hole = part_->drawing.stock.inner_mm;
  part::Shaft shaft{part_->material.E_MPa, part_->material.nu, {}};
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    double z0 = ends[k], z1 = ends[k + 1];
    if (!(z1 - z0 > 1e-9)) continue;
    const auto o = zone_at(outer, (z0 + z1) / 2), i = zone_at(inner, (z0 + z1) / 2);
    const double length = z1 - z0;
    if (sign_ < 0) std::swap(z0, z1);
    shaft.segments.push_back({length, diameter(o, z0), diameter(o, z1),
                              std::max(hole, diameter(i, z0)),
                              std::max(hole, diameter(i, z1))});
  }
  if (sign_ < 0) std::reverse(shaft.segments.begin(), shaft.segments.end());
  return shaft;
}

part::Shaft SetupBody::shaft(const Element& element, double left_mm) const {
  auto outer = outer_, inner = inner_;
  const auto leave = [&](Zone& zone, const auto& e, double more) {
    zone.d0 = e.left_mm + more;
    zone.d1 = e.right_mm + more;
  };
  const auto& d = part_->drawing;
  if (element.inner)
    leave(inner[element.index], d.inner[element.index], -2 * left_mm);
  else
    leave(outer[element.index], d.outer[element.index], 2 * left_mm);
  return shaft(outer, inner);
}

part::Shaft SetupBody::shaft() const { return shaft(outer_, inner_); }

}  // namespace turnwright::planning
