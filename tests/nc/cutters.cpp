#include "cutters.hpp"

#include <algorithm>
#include <cmath>

#include "review/cut/edges.hpp"
#include "turnwright/catalogue/tool_outline.hpp"
#include "turnwright/cutting/fixed.hpp"

namespace turnwright::nc::test {
namespace {

using catalogue::FixedUse;
using planning::OperationKind;
using planning::OperationPlan;

constexpr double kShank_mm = 100;  // of blades, above what they reach
constexpr double kLong_mm = 1000;  // as a drill
constexpr double kWheel_mm = 5;    // of a knurling tool, above its holder

const catalogue::FixedTool* fixed_tool(const Planned& p, const OperationPlan& o) {
  for (const auto& t : p.part.fixed_tools)
    if (t.id == o.tool) return &t;
  return nullptr;
}

bool is_inner(const Planned& p, const OperationPlan& o) {
  const auto e = part::extent(p.part.drawing, o.on[0]);
  return (e && e->inner) || std::ranges::any_of(p.part.tools, [&](const auto& t) {
           return t.id == o.tool && t.bar;
         });
}

double pitch_mm(const Planned& p, const OperationPlan& o) {
  const auto pitch = [&](const auto& elements) {
    for (const auto& e : elements)
      if (e.id == o.on[0] && e.cut) return e.cut->pitch_mm;
    return 0.0;
  };
  return std::max(pitch(p.part.drawing.outer), pitch(p.part.drawing.inner));
}

// A centre drill counts as a cone, with a rim that leaves the face square around the hole.
constexpr double kRim_mm = 0.05;
double centre_cone_mm(const catalogue::FixedTool& t, double D) {
  return catalogue::tip_depth_mm(t, D) - kRim_mm;
}

Cutter drill(double D, double point_deg) {
  Cutter c;
  c.drills = true;
  c.edge = pointed_edge(D, cutting::drill_point_mm(D, point_deg));
  return c;
}

// The smallest that is as wide as the chamfer.
double countersink_mm(const Planned& p, const OperationPlan& o,
                      const catalogue::FixedTool& t) {
  const auto& e =
      *std::ranges::find(p.part.drawing.inner, o.on[0], &part::InnerElement::id);
  const auto setup = std::ranges::find_if(p.plan.setups, [&](const auto& s) {
    return std::ranges::find(s.operations, o.id, &OperationPlan::id) !=
           s.operations.end();
  });
  const auto s = static_cast<std::size_t>(setup - p.plan.setups.begin());
  const bool left_is_free = p.part.setups[s].hold == part::End::right;
  const auto& c = left_is_free ? e.left_chamfer : e.right_chamfer;
  return *std::ranges::lower_bound(t.sizes_mm, e.left_mm + 2 * c->radial_mm);
}

// A reamer or a tap cuts to its whole diameter behind its lead; what the lead does is in
// the drilled hole's own allowance.
Cutter behind_lead(const Planned& p, const OperationPlan& o,
                   const catalogue::FixedTool& t) {
  const auto& e =
      *std::ranges::find(p.part.drawing.inner, o.on[0], &part::InnerElement::id);
  const bool taps = t.use == FixedUse::tapping;
  const double r = e.cut->drawn.left_mm / 2;
  const double lead = taps ? t.lead * e.cut->pitch_mm : t.lead;
  Cutter c;
  c.drills = true;
  c.threads = taps;
  c.edge = rectangle(-r, r, lead, kLong_mm);
  return c;
}

Cutter fixed_cutter(const Planned& p, const OperationPlan& o,
                    const catalogue::FixedTool& t) {
  const double ap = o.passes[0].ap_mm;
  Cutter c;
  c.re_mm = t.re_mm;
  switch (t.use) {
    case FixedUse::centring:
      return drill(2 * ap,
                   units::deg_from_rad(2 * std::atan(ap / centre_cone_mm(t, 2 * ap))));
    case FixedUse::drilling:
      return drill(2 * ap, t.point_deg);
    case FixedUse::countersinking:
      return drill(countersink_mm(p, o, t), t.point_deg);
    case FixedUse::counterboring:
    case FixedUse::reaming:
    case FixedUse::tapping:
      return behind_lead(p, o, t);
    case FixedUse::grooving:
    case FixedUse::parting:
      c.plunges = true;
      c.edge = rectangle(0, t.reach, 0, ap);
      if (!is_inner(p, o)) c.holder = {rectangle(t.reach, t.reach + kShank_mm, 0, ap)};
      return c;
    case FixedUse::threading:
      c.threads = true;
      c.edge = thread_edge(pitch_mm(p, o));
      return c;
    case FixedUse::knurling:  // presses what it goes through: as if a thread were cut
      c.threads = true;
      c.edge = rectangle(0, kWheel_mm, 0, ap);
      return c;
    case FixedUse::profiling:
      c.edge = profiling_edge(t.re_mm);
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
    c.edge = insert_edge(outline);
    for (const auto& piece : outline.holder) c.holder.push_back(polygon_of(piece));
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
  if (t->use == FixedUse::centring) return Drilled{D, centre_cone_mm(*t, D), kRim_mm};
  double depth = t->reach * D;
  if (t->use == FixedUse::drilling) {
    depth = 0;
    double needed = 0;
    const auto free =
        p.part.setups[setup].hold == part::End::left ? part::End::right : part::End::left;
    for (const auto& e : p.part.drawing.inner) {
      if (e.from == free) depth += e.length_mm;
      if (e.from == free && e.cut) {
        const double room = e.cut->kind == part::CutKind::thread ? e.cut->pitch_mm : 0;
        needed = std::max(needed, depth + e.cut->lead_mm + room);
      }
    }
    depth = std::max(depth, needed);
  }
  return Drilled{D, cutting::drill_point_mm(D, t->point_deg), depth};
}

}  // namespace turnwright::nc::test
