#include "edges.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "approach.hpp"
#include "planning/clamping/positions.hpp"
#include "planning/values/surface_request.hpp"

namespace turnwright::planning {

using part::End;

End free_end(const PreparedPart& p, std::size_t setup) {
  return opposite(p.setups[setup].hold);
}

bool makes(const SetupWork& work, const Element& e) {
  const auto& all = e.inner ? work.bores : work.elements;
  return std::find(all.begin(), all.end(), e.index) != all.end();
}

double beyond_edge_mm(const part::Chamfer& c, bool in_stock, double corner_mm) {
  constexpr double kAboveSurface_mm = 0.05;
  if (c.round) return in_stock ? corner_mm : 0;
  if (!in_stock) return corner_mm + kBehind_mm;
  const double angle = std::atan2(c.radial_mm, c.axial_mm);
  return corner_mm * std::tan((std::numbers::pi / 2 - angle) / 2) + kAboveSurface_mm;
}

double before_rounding_mm(double distance_mm) {
  return distance_mm * std::numbers::sqrt2 / 2;
}

double ring_depth_mm(const part::Chamfer& c, double corner_mm, double on_wall_mm) {
  return c.axial_mm + beyond_edge_mm(c, true, corner_mm) + on_wall_mm;
}

bool takes_ring(const catalogue::Tool& tool, const part::Chamfer& c) {
  return ring_depth_mm(c, tool.re_mm, catalogue::least_depth_mm(tool)) <=
         tool.ap_mm.upper;
}

double end_z_mm(const part::Drawing& d, const Element& e, End end) {
  const double left =
      e.inner ? part::inner_left_z_mm(d, e.index) : part::left_z_mm(d, e.index);
  const double length = e.inner ? d.inner[e.index].length_mm : d.outer[e.index].length_mm;
  return end == End::left ? left : left + length;
}

std::optional<Element> neighbour(const part::Drawing& d, const Element& e, End end) {
  const auto left_mm = e.inner ? part::inner_left_ends_mm(d) : part::left_ends_mm(d);
  const auto at_mm = [&](std::size_t i, End which) {
    if (which == End::left) return left_mm[i];
    return left_mm[i] + (e.inner ? d.inner[i].length_mm : d.outer[i].length_mm);
  };
  const double z = at_mm(e.index, end);
  for (std::size_t i = 0; i < left_mm.size(); ++i)
    if (i != e.index && std::abs(at_mm(i, part::opposite(end)) - z) < kNoWall_mm)
      return Element{e.inner, i};
  return std::nullopt;
}

const std::optional<part::Chamfer>& chamfer_at(const part::Drawing& d, const Element& e,
                                               End end) {
  const auto of = [&](const auto& element) -> const std::optional<part::Chamfer>& {
    return end == End::left ? element.left_chamfer : element.right_chamfer;
  };
  return e.inner ? of(d.inner[e.index]) : of(d.outer[e.index]);
}

std::optional<part::Chamfer> turned(const std::optional<part::Chamfer>& c) {
  return c && c->by_blade ? std::nullopt : c;
}

std::optional<part::Chamfer> front_chamfer(const PreparedPart& p, std::size_t setup,
                                           const Element& e) {
  return turned(chamfer_at(p.drawing, e, free_end(p, setup)));
}

Rims rims_of(const PreparedPart& p, std::size_t setup, const Element& groove) {
  const auto rim = [&](End end) -> std::optional<part::Chamfer> {
    const auto next = neighbour(p.drawing, groove, end);
    if (!next) return std::nullopt;
    const auto& c = chamfer_at(p.drawing, *next, part::opposite(end));
    return c && c->by_blade ? c : std::nullopt;
  };
  const End front = free_end(p, setup);
  return {rim(front), rim(part::opposite(front))};
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

bool faces_behind(const PreparedPart& p, std::size_t setup, const SetupWork& work,
                  const Element& e) {
  if (e.inner) return false;
  const std::size_t shoulder = free_end(p, setup) == End::left ? e.index + 1 : e.index;
  return std::ranges::find(work.shoulders, shoulder) != work.shoulders.end();
}

bool faces_between(const SetupWork& work, const Element& front, const Element& behind) {
  const auto& all = front.inner ? work.inner_shoulders : work.shoulders;
  const auto shoulder = front.inner ? front.index : std::max(front.index, behind.index);
  return std::ranges::find(all, shoulder) != all.end();
}

std::vector<const catalogue::Tool*> shoulder_tools(const PreparedPart& p,
                                                   const Element& front,
                                                   const Element& behind) {
  if (front.inner) return tools_for(p, catalogue::ToolUse::boring);
  const auto& outer = p.drawing.outer;
  const std::size_t k = std::max(front.index, behind.index);
  const bool undercut = outer[k - 1].right_undercut || outer[k].left_undercut;
  return tools_for(p,
                   undercut ? catalogue::ToolUse::finishing : catalogue::ToolUse::facing);
}

UndercutWay undercut_way(const part::Undercut& u, double r) {
  UndercutWay w;
  w.lean_rad = part::leans_rad(u);
  w.radius_mm = std::max(0.0, u.radius_mm - r);
  w.centre_h = w.radius_mm;
  w.centre_z = part::centre_mm(u) - r;
  w.arc_h = w.radius_mm * (1 + std::sin(w.lean_rad));
  w.arc_z = w.centre_z - w.radius_mm * std::cos(w.lean_rad);
  w.foot_h = part::height_mm(u) - r * (1 + std::tan(w.lean_rad / 2));
  return w;
}

double slope_excess_mm(const part::Undercut& u) {
  return u.depth_mm * std::tan(part::falls_rad(u) / 2);
}

}  // namespace turnwright::planning
