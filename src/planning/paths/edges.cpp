#include "edges.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

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
    return free_end(p, setup) == End::left ? element.left_chamfer : element.right_chamfer;
  };
  return e.inner ? of(p.drawing.inner[e.index]) : of(p.drawing.outer[e.index]);
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
