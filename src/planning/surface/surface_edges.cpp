#include <fmt/format.h>

#include <cmath>

#include "machined_surface.hpp"
#include "planning/clamping/centre_clearance.hpp"
#include "planning/paths/approach.hpp"
#include "planning/paths/edges.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::planning {

bool MachinedSurface::makes_edges(const catalogue::Tool& tool) const {
  const auto& s = around_;
  if (s.fillet_mm && tool.re_mm > *s.fillet_mm) return false;
  const bool into_stock = s.wall_in_stock && s.wall_chamfer.axial_mm > 0;
  if (into_stock && !takes_ring(tool, s.wall_chamfer)) return false;
  return !s.undercut ||
         (tool.re_mm <= s.undercut->radius_mm &&
          (!(s.undercut->recess_mm > 0) || catalogue::goes_behind_shoulders(tool)) &&
          units::rad_from_deg(tool.minor_kapr_deg) >= part::kUndercutFalls_rad &&
          tool.ap_mm.upper > s.undercut->depth_mm);
}

std::string MachinedSurface::edges_asked() const {
  const auto& s = around_;
  std::string all;
  const auto add = [&](const std::string& what) {
    all += (all.empty() ? "" : ", ") + what;
  };
  if (s.fillet_mm)
    add(fmt::format("a corner of at most {:g} mm for the fillet", *s.fillet_mm));
  if (s.undercut)
    add(fmt::format(
        "a corner of at most {:g} mm{} and a minor edge of at least {:g} deg for "
        "the undercut",
        s.undercut->radius_mm,
        s.undercut->recess_mm > 0
            ? fmt::format(", a KAPR of at least {:g} deg",
                          90 + units::deg_from_rad(part::kUndercutLeans_rad))
            : std::string(),
        units::deg_from_rad(part::kUndercutFalls_rad)));
  if (s.wall_in_stock && s.wall_chamfer.axial_mm > 0)
    add(fmt::format("a depth of cut for the chamfer of {:g} mm into stock",
                    s.wall_chamfer.axial_mm));
  return all;
}

bool MachinedSurface::clears_centre(const catalogue::Tool& tool) const {
  if (kind_ != Kind::element || !has_live_centre(clamping_)) return true;
  const double far = kBefore_mm + tool.re_mm;
  const auto& c = around_.front_chamfer;
  const double along = std::hypot(c.axial_mm, c.radial_mm);
  const double fall = along > 0 ? far * c.radial_mm / along : 0;
  const double lowest = around_.h0 - c.radial_mm - fall;
  return lowest >= clear_of_centre_mm(*plan_, setup_, tool, around_.z0 + far);
}

}  // namespace turnwright::planning
