#include "edges.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planning/clamping/positions.hpp"

namespace turnwright::planning {

using part::End;

End free_end(const PreparedPart& p, std::size_t setup) {
  return opposite(p.setups[setup].hold);
}

bool makes(const SetupWork& work, const Element& e) {
  const auto& all = e.inner ? work.bores : work.elements;
  return std::find(all.begin(), all.end(), e.index) != all.end();
}

double beyond_surface_mm(const part::Chamfer& c, double corner_mm) {
  constexpr double kAboveSurface_mm = 0.05;
  const double angle = std::atan2(c.radial_mm, c.axial_mm);
  return corner_mm * std::tan((std::numbers::pi / 2 - angle) / 2) + kAboveSurface_mm;
}

bool takes_ring(const catalogue::Tool& tool, const part::Chamfer& c) {
  return c.axial_mm + beyond_surface_mm(c, tool.re_mm) +
             catalogue::least_depth_mm(tool) <=
         tool.ap_mm.upper;
}

std::optional<part::Chamfer> front_chamfer(const PreparedPart& p, std::size_t setup,
                                           const Element& e) {
  const auto of = [&](const auto& element) {
    const auto& c =
        free_end(p, setup) == End::left ? element.left_chamfer : element.right_chamfer;
    return c && c->by_blade ? std::nullopt : c;
  };
  return e.inner ? of(p.drawing.inner[e.index]) : of(p.drawing.outer[e.index]);
}

Rims rims_of(const PreparedPart& p, std::size_t setup, const Element& groove) {
  const auto& d = p.drawing;
  Rims rims;
  const auto look = [&](const auto& list, const auto& left_z_mm) {
    const double z0 = left_z_mm(groove.index), z1 = z0 + list[groove.index].length_mm;
    for (std::size_t i = 0; i < list.size(); ++i) {
      const double a = left_z_mm(i), b = a + list[i].length_mm;
      const auto take = [&](End side, const std::optional<part::Chamfer>& c) {
        if (c && c->by_blade) (side == free_end(p, setup) ? rims.front : rims.back) = c;
      };
      if (std::abs(b - z0) < kNoWall_mm) take(End::left, list[i].right_chamfer);
      if (std::abs(a - z1) < kNoWall_mm) take(End::right, list[i].left_chamfer);
    }
  };
  if (groove.inner)
    look(d.inner, [&](std::size_t i) { return part::inner_left_z_mm(d, i); });
  else
    look(d.outer, [&](std::size_t i) { return part::left_z_mm(d, i); });
  return rims;
}

std::optional<double> fillet_behind_mm(const PreparedPart& p, std::size_t setup,
                                       const Element& e) {
  const auto of = [&](const auto& element) {
    return free_end(p, setup) == End::left ? element.right_fillet_mm
                                           : element.left_fillet_mm;
  };
  return e.inner ? of(p.drawing.inner[e.index]) : of(p.drawing.outer[e.index]);
}

std::optional<part::Undercut> undercut_behind(const PreparedPart& p, std::size_t setup,
                                              const Element& e) {
  if (e.inner) return std::nullopt;
  const auto& element = p.drawing.outer[e.index];
  return free_end(p, setup) == End::left ? element.right_undercut : element.left_undercut;
}

}  // namespace turnwright::planning
