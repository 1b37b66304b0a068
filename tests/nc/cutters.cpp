#include "cutters.hpp"

#include <algorithm>
#include <cmath>

#include "turnwright/catalogue/tool_outline.hpp"

namespace turnwright::nc::test {
namespace {

using catalogue::FixedUse;
using planning::OperationKind;
using planning::OperationPlan;

constexpr double kChord_mm = 1e-5;        // of corners that cut
constexpr double kOthersChord_mm = 1e-3;  // and of the insert's other corners
constexpr double kShank_mm = 100;         // of blades, above what they reach

Polygon polygon(const catalogue::ConvexOutline& outline) {
  Polygon all;
  for (const auto& p : outline) all.push_back({p.h_mm, p.z_mm});
  return hull(std::move(all));
}

Polygon rectangle(double x0, double x1, double z0, double z1) {
  return hull({{x0, z0}, {x0, z1}, {x1, z1}, {x1, z0}});
}

Polygon insert_polygon(const catalogue::ToolOutline& outline) {
  const double r = outline.re_mm;
  const auto cuts = [&](const catalogue::OutlinePoint& p) {
    return std::hypot(p.h_mm - r, p.z_mm - r) < r + 1e-9;
  };
  catalogue::ConvexOutline all;
  for (const auto& p : catalogue::rounded_insert(outline, kChord_mm))
    if (cuts(p)) all.push_back(p);
  for (const auto& p : catalogue::rounded_insert(outline, kOthersChord_mm))
    if (!cuts(p)) all.push_back(p);
  return polygon(all);
}

// A corner between two edges of a length.
Polygon wedge(double re, double kapr_rad, double minor_rad, double length) {
  const double eps = M_PI - kapr_rad - minor_rad;
  const catalogue::OutlinePoint major{std::sin(kapr_rad), -std::cos(kapr_rad)},
      minor{std::sin(minor_rad), std::cos(minor_rad)};
  const double back = re / std::sin(eps);
  const catalogue::OutlinePoint corner{re - back * (major.h_mm + minor.h_mm),
                                       re - back * (major.z_mm + minor.z_mm)};
  const auto on = [&](const catalogue::OutlinePoint& edge) {
    return catalogue::OutlinePoint{corner.h_mm + length * edge.h_mm,
                                   corner.z_mm + length * edge.z_mm};
  };
  return insert_polygon({re, {corner, on(major), on(minor)}, {}});
}

const catalogue::FixedTool* fixed_tool(const Planned& p, const OperationPlan& o) {
  for (const auto& t : p.part.fixed_tools)
    if (t.id == o.tool) return &t;
  return nullptr;
}

bool is_inner(const Planned& p, const OperationPlan& o) {
  const auto e = part::extent(p.part.drawing, o.on[0]);
  return e && e->inner;
}

double pitch_mm(const Planned& p, const OperationPlan& o) {
  const auto pitch = [&](const auto& elements) {
    for (const auto& e : elements)
      if (e.id == o.on[0] && e.cut) return e.cut->pitch_mm;
    return 0.0;
  };
  return std::max(pitch(p.part.drawing.outer), pitch(p.part.drawing.inner));
}

double point_mm(double D_mm, double point_deg) {
  return D_mm / 2 / std::tan(point_deg * M_PI / 360);
}

Cutter drill(double D, double point_deg) {
  const double r = D / 2, point = point_mm(D, point_deg), far = 1000;
  Cutter c;
  c.drills = true;
  c.edge = hull({{0, 0}, {r, point}, {r, far}, {-r, far}, {-r, point}});
  return c;
}

// The width of a profiling tool's 35 deg insert is in no document; here it is as wide as
// its edges may be: the minor edge at the angle that it is taken to clear, the major edge
// at 93 deg.
constexpr double kProfilingKapr_rad = 93 * M_PI / 180;

Cutter fixed_cutter(const Planned& p, const OperationPlan& o,
                    const catalogue::FixedTool& t) {
  const double ap = o.passes[0].ap_mm;
  Cutter c;
  c.re_mm = t.re_mm;
  switch (t.use) {
    case FixedUse::centring:
    case FixedUse::drilling:
      return drill(2 * ap, t.point_deg);
    case FixedUse::grooving:
    case FixedUse::parting:
      c.plunges = true;
      c.edge = rectangle(0, t.reach, 0, ap);
      if (!is_inner(p, o)) c.holder = {rectangle(t.reach, t.reach + kShank_mm, 0, ap)};
      return c;
    case FixedUse::threading: {
      // Its tooth; the insert beside it is in no document.
      const double h = 0.8 * pitch_mm(p, o), w = h * std::tan(M_PI / 6);
      c.threads = true;
      c.edge = hull({{0, 0}, {h, w}, {h, -w}});
      return c;
    }
    case FixedUse::profiling:
      c.edge = wedge(t.re_mm, kProfilingKapr_rad, part::kProfilingClears_rad, 12);
      return c;
  }
  return c;
}

bool finishes(const Planned& p, const OperationPlan& o) {
  const auto* t = fixed_tool(p, o);
  return t ? t->use == FixedUse::profiling
           : o.kind == OperationKind::finish || o.kind == OperationKind::bore_finish;
}

}  // namespace

Cutter cutter(const Planned& p, const OperationPlan& o) {
  Cutter c;
  if (const auto* t = fixed_tool(p, o)) c = fixed_cutter(p, o, *t);
  c.finishes = finishes(p, o);
  c.inner = c.drills || is_inner(p, o);
  for (const auto& t : p.part.tools) {
    if (t.id != o.tool) continue;
    const auto outline = catalogue::outline(t);
    c.re_mm = t.re_mm;
    c.edge = insert_polygon(outline);
    for (const auto& piece : outline.holder) c.holder.push_back(polygon(piece));
  }
  return c;
}

std::map<std::string, double> finishing_corners_mm(const Planned& p) {
  std::map<std::string, double> all;
  const auto add = [&](const std::string& surface, double re) {
    all[surface] = std::max(all[surface], re);
  };
  for (const auto& s : p.plan.setups)
    for (const auto& o : s.operations) {
      if (!finishes(p, o) && o.kind != OperationKind::face) continue;
      const double re = cutter(p, o).re_mm;
      for (const auto& id : o.on) {
        const auto bar = id.find('|');
        add(id.substr(0, bar), re);
        if (bar != id.npos) add(id.substr(bar + 1), re);
      }
    }
  // The walls at a drilled hole are made with the bores beside it.
  const auto& bores = p.part.drawing.inner;
  for (const auto& hole : bores)
    for (const auto& e : bores)
      if (part::is_hole(hole) && !part::is_hole(e) && all.contains(e.id))
        add(hole.id, all[e.id]);
  return all;
}

std::optional<Drilled> drilled(const Planned& p, std::size_t setup,
                               const OperationPlan& o) {
  const auto* t = fixed_tool(p, o);
  if (!t || (t->use != FixedUse::centring && t->use != FixedUse::drilling))
    return std::nullopt;
  const double D = 2 * o.passes[0].ap_mm;
  double depth = t->reach * D;
  if (t->use == FixedUse::drilling) {
    depth = 0;
    const auto free =
        p.part.setups[setup].hold == part::End::left ? part::End::right : part::End::left;
    for (const auto& e : p.part.drawing.inner)
      if (e.from == free) depth += e.length_mm;
  }
  return Drilled{D, point_mm(D, t->point_deg), depth};
}

}  // namespace turnwright::nc::test
