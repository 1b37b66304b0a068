#include <algorithm>
#include <cmath>

#include "base/say.hpp"
#include "machined_surface.hpp"
#include "planning/clamping/centre_clearance.hpp"
#include "planning/paths/approach.hpp"
#include "planning/paths/edges.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::planning {
namespace {

constexpr double kSame_rad = 1e-9;

}  // namespace

// Where no operations are given, the tool that finishes an element also faces the shoulder
// behind its undercut.
std::optional<part::Undercut> MachinedSurface::undercut_of_last() const {
  return around_.undercut || plan_->operations ? around_.undercut
                                               : around_.faced_undercut;
}

// Whether it cuts the edge of the wall behind while that is stock.  Where a facing operation
// makes the wall, that one does.
bool MachinedSurface::cuts_ring() const {
  const auto& s = around_;
  return s.wall_in_stock && s.wall_chamfer.axial_mm > 0 && !(s.shoulder_mm > 0);
}

bool MachinedSurface::makes_edges(const catalogue::Tool& tool) const {
  const auto& s = around_;
  if (s.fillet_mm && tool.re_mm > *s.fillet_mm) return false;
  if (s.below_rounding_mm && tool.re_mm > *s.below_rounding_mm) return false;
  if (cuts_ring() && ring_asked_mm(tool) > tool.ap_mm.upper) return false;
  const auto u = undercut_of_last();
  return !u ||
         (tool.re_mm <= u->radius_mm &&
          (!(u->recess_mm > 0) || units::rad_from_deg(tool.kapr_deg) >=
                                      units::kPi / 2 + part::leans_rad(*u) - kSame_rad) &&
          units::rad_from_deg(tool.minor_kapr_deg) >= part::falls_rad(*u) - kSame_rad &&
          tool.ap_mm.upper > u->depth_mm);
}

// Whether other plans may face that wall.
bool MachinedSurface::ring_may_be_faced() const {
  if (kind_ != Kind::element) return false;
  const auto& shoulders = plan_->work.setups[setup_].before_stock;
  const std::size_t k = around_.mirrored ? index_ + 1 : index_;
  return std::ranges::find(shoulders, k) != shoulders.end();
}

// Depth of the ring of stock there with what stands on the wall.  Outwards along the edge
// the major edge meets it in its whole height.
double MachinedSurface::ring_mm(const catalogue::Tool& tool, double on_wall_mm) const {
  const auto& s = around_;
  const auto& c = s.wall_chamfer;
  const double along = ring_depth_mm(c, tool.re_mm, on_wall_mm);
  if (is_face()) return along;
  const double across = c.axial_mm / std::hypot(c.axial_mm, c.radial_mm);
  return std::max(along, (s.wall_h - s.wall_edge_h) * across);
}

// The largest depth that a tool must have for the ring.  Where no plan may face the wall the
// short cut into the ring's whole height is allowed beyond it, or the part could not be made.
double MachinedSurface::ring_asked_mm(const catalogue::Tool& tool) const {
  const double on_wall_mm = catalogue::least_depth_mm(tool);
  return ring_may_be_faced()
             ? ring_mm(tool, on_wall_mm)
             : ring_depth_mm(around_.wall_chamfer, tool.re_mm, on_wall_mm);
}

std::optional<EdgeRing> MachinedSurface::ring(const Recipe& recipe,
                                              const OperationModel& o) const {
  if (!cuts_ring()) return {};
  const double on_wall_mm = is_face()       ? o.ap.lower
                            : recipe.finish ? catalogue::least_depth_mm(*recipe.finish)
                                            : 0;
  return EdgeRing{ring_mm(*o.tool, on_wall_mm),
                  2 * (is_face() ? top_mm_ : std::abs(around_.wall_h))};
}

std::string MachinedSurface::edges_asked() const {
  const auto& s = around_;
  std::string all;
  const auto add = [&](const std::string& what) {
    all += (all.empty() ? "" : ", ") + what;
  };
  if (s.fillet_mm) add(say("a corner of at most {:g} mm for the fillet", *s.fillet_mm));
  if (s.below_rounding_mm)
    add(say("a corner of at most {:.3g} mm for the wall below the rounded edge",
            *s.below_rounding_mm));
  if (const auto u = undercut_of_last())
    add(say(
        "a corner of at most {:g} mm{}, a minor edge of at least {:g} deg and a largest "
        "depth of cut beyond {:g} mm for the undercut",
        u->radius_mm,
        u->recess_mm > 0 ? say(", a KAPR of at least {:g} deg",
                               90 + units::deg_from_rad(part::leans_rad(*u)))
                         : std::string(),
        units::deg_from_rad(part::falls_rad(*u)), u->depth_mm));
  if (cuts_ring() && !plan_->tools.empty()) {
    double least_mm = INFINITY;
    for (const auto& t : plan_->tools) least_mm = std::min(least_mm, ring_asked_mm(t));
    add(say("a depth of cut of {:.3g} mm for the {} of {:g} mm into stock", least_mm,
            s.wall_chamfer.round ? tr("rounded edge") : tr("chamfer"),
            s.wall_chamfer.axial_mm));
  }
  return all;
}

catalogue::ToolUse MachinedSurface::last_use() const {
  if (by_bar()) return catalogue::ToolUse::boring;
  return is_face() && !around_.undercut ? catalogue::ToolUse::facing
                                        : catalogue::ToolUse::finishing;
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
