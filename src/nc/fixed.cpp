#include "fixed.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/say.hpp"
#include "contour.hpp"
#include "planning/auxiliary/hole_operations.hpp"
#include "planning/paths/edges.hpp"
#include "planning/paths/pass_lengths.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/cutting/fixed.hpp"

namespace turnwright::nc {
namespace {

using catalogue::FixedTool;
using catalogue::FixedUse;
using planning::OperationPlan;
using Kind = Move::Kind;

const FixedTool& fixed_tool_of(const Site& site, const OperationPlan& o) {
  return *std::find_if(site.part.fixed_tools.begin(), site.part.fixed_tools.end(),
                       [&](const FixedTool& t) { return t.id == o.tool; });
}

void drill(Site& site, const OperationPlan& o, const FixedTool& tool) {
  const double D = 2 * o.passes[0].ap_mm;
  const bool centre = tool.use == FixedUse::centring;
  const auto end = site.sign > 0 ? part::End::right : part::End::left;
  const double tip =
      centre ? catalogue::tip_depth_mm(tool, D)
             : planning::drilled_depth_mm(site.part, site.setup, end, tool.reach * D) +
                   cutting::drill_point_mm(D, tool.point_deg);
  site.rapid(0, site.at.z_mm);
  site.rapid(0, site.front + kBefore_mm);
  if (tool.pecking)
    site.pecks =
        Pecks{tool.pecking->first_diameters * D, tool.pecking->step_diameters * D};
  double reached = 0;
  for (const double to : cutting::peck_depths_mm(tool.pecking, D, site.front + tip)) {
    if (reached > 0) site.rapid(0, site.front - reached + kPeck_mm);
    site.to(Kind::feed, site.outer, {0, site.front - to});
    site.rapid(0, site.front + kBefore_mm);
    reached = to;
  }
  if (centre) return;
  site.inner.stock_h = -D / 2;
  for (auto& s : site.inner.items) {
    const auto& bore = site.part.drawing.inner[s.index];
    if (part::is_hole(bore) && bore.from == end) {
      s.stock = false;
      s.finished = true;
    }
  }
}

struct Place {
  Side& side;
  std::size_t k;
  Surface& surface() const { return side.items[k]; }
};

Place place_of(Site& site, const std::string& id) {
  for (Side* side : {&site.outer, &site.inner})
    for (std::size_t k = 0; k < side->items.size(); ++k)
      if (side->items[k].id == id) return {*side, k};
  throw std::domain_error("nc: no element " + id);
}

// Down to the chamfer's width where a hole begins; the tool is set by its cone's point.
void countersink(Site& site, const OperationPlan& o, const FixedTool& tool) {
  const auto& s = place_of(site, o.on[0]).surface();
  const double D = 2 * (s.front->radial_mm - s.h0);
  site.rapid(0, site.at.z_mm);
  site.rapid(0, site.front + kBefore_mm);
  site.rapid(0, s.z0 + kBefore_mm);
  site.to(Kind::feed, site.outer, {0, s.z0 - cutting::drill_point_mm(D, tool.point_deg)});
  site.rapid(0, s.z0 + kBefore_mm);
  site.rapid(0, site.front + kBefore_mm);
}

// Down to the floor of a counterbore.
void counterbore(Site& site, const OperationPlan& o) {
  const auto& s = place_of(site, o.on[0]).surface();
  const auto way = planning::counterbore_way(site.part.drawing, s.index, site.front);
  site.rapid(0, site.at.z_mm);
  site.rapid(0, site.front + kBefore_mm);
  site.rapid(0, way.from_mm + kBefore_mm);
  site.to(Kind::feed, site.outer, {0, way.to_mm});
  site.rapid(0, site.front + kBefore_mm);
  site.inner.stock_h = std::min(site.inner.stock_h, s.h0);
}

// Through a hole, beyond it by the tool's lead, and back: a reamer at feed, a tap with the
// spindle reversed in step.
void through_hole(Site& site, const OperationPlan& o, Kind kind) {
  const auto& s = place_of(site, o.on[0]).surface();
  const auto& cut = *cut_of(site, s);
  const double from =
      planning::hole_start_mm(s.z0, site.front) + planning::before_hole_mm(cut);
  const double outside = std::max(from, site.front + kBefore_mm);
  site.rapid(0, site.at.z_mm);
  site.rapid(0, outside);
  site.rapid(0, from);
  site.to(kind, site.outer, {0, s.z1 - cut.lead_mm});
  site.to(kind, site.outer, {0, from});
  site.rapid(0, outside);
}

// Whether material towards the free end is in the way of an operation that begins at a
// position; if so it is reported as not programmable.
bool unfaced(Site& site, const OperationPlan& o, const Surface& s, double z) {
  if (!(site.front > 0 && z > 0)) return false;
  site.refuse(o.id, say("the end that {} begins at is not faced, {:.3g} mm stand "
                        "before it",
                        s.id, site.front));
  return true;
}

bool rises_behind(const Site& site, const Place& p, double h) {
  if (end_of_run(p.side, p.k) == p.k)
    return hole_goes_on(site, p.side, p.surface().z1, h + kSame_mm);
  return p.side.top0(p.side.items[p.k + 1]) > h + kSame_mm;
}

// Along the chamfer at a rim of a groove, from its outer end, of the height h, into the
// groove.
void rim(Site& site, Side& side, const part::Chamfer& c, double h, double from_z,
         double to_z) {
  const double above = h + site.above(side);
  site.approach(side, {above, from_z});
  site.to(Kind::feed, side, {h, from_z});
  site.to(Kind::feed, side, {h - c.radial_mm, to_z});
  site.rapid(side.sign * above, to_z);
}

void groove(Site& site, const OperationPlan& o, const Place& p) {
  auto& s = p.surface();
  const double w = o.passes[0].ap_mm, above = s.h0 + site.above(p.side);
  const double floor = p.side.sign * cut_of(site, s)->core.left_mm / 2;
  const auto n = o.passes.size();
  const double step = n > 1 ? (s.z0 - s.z1 - w) / static_cast<double>(n - 1) : 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double z = s.z1 + static_cast<double>(i) * step;
    const double beside = i == 0 && rises_behind(site, p, s.h1) ? kBehind_mm : 0;
    site.approach(p.side, {above, z + beside});
    site.to(Kind::feed, p.side, {above, z});
    site.to(Kind::feed, p.side, {floor, z});
    site.rapid(p.side.sign * above, z);
  }
  const auto rims =
      planning::rims_of(site.part, site.setup, planning::Element{s.inner, s.index});
  const auto line = [&](std::size_t k) {
    return corrected(site, p.side, p.side.items[k]);
  };
  if (rims.back)
    rim(site, p.side, *rims.back, line(p.k + 1).front().h_mm, s.z1 - rims.back->axial_mm,
        s.z1);
  if (rims.front)
    rim(site, p.side, *rims.front, line(p.k - 1).back().h_mm,
        s.z0 + rims.front->axial_mm - w, s.z0 - w);
  s.h0 = s.h1 = floor;
}

void thread(Site& site, const OperationPlan& o, const Place& p) {
  auto& s = p.surface();
  const auto& cut = *cut_of(site, s);
  const double P = cut.pitch_mm, root = p.side.sign * cut.core.left_mm / 2;
  const auto room =
      planning::thread_room(site.part, site.setup, {s.inner, s.index}, root);
  const double run_in = planning::run_in_mm(room, P).value();  // else there is no plan
  if (unfaced(site, o, s, s.z0 + run_in)) return;
  const double end = s.z1 + (room.stands_behind ? P : 0);
  const Point before{s.h0 + site.above(p.side), s.z0 + run_in};
  site.approach(p.side, before);
  double h = root + cut.depth_mm;
  for (const auto& pass : o.passes) {
    h -= pass.ap_mm;
    site.rapid(p.side.sign * h, before.z_mm);
    site.to(Kind::thread, p.side, {h, end});
    site.rapid(p.side.sign * before.h_mm, end);
    site.rapid(p.side.sign * before.h_mm, before.z_mm);
  }
}

// Straight down to the root of a knurl, and along it.
void knurl(Site& site, const OperationPlan& o, const Place& p) {
  auto& s = p.surface();
  const auto& cut = *cut_of(site, s);
  const double width = o.passes[0].ap_mm, root = s.h0 - cut.depth_mm;
  const auto room =
      planning::thread_room(site.part, site.setup, {s.inner, s.index}, root);
  const auto [from, to] =
      planning::knurl_way(room, s.z0, s.z1, width).value();  // else there is no plan
  if (unfaced(site, o, s, from + width)) return;
  const double above = s.h0 + site.above(p.side);
  site.approach(p.side, {above, from});
  site.to(Kind::feed, p.side, {root, from});
  if (to < from) site.to(Kind::feed, p.side, {root, to});
  site.rapid(p.side.sign * above, to);
  s.h0 = s.h1 = cut.drawn.left_mm / 2;
}

// Path of a tool along an arc as far as it does not cut the surfaces in front of it and
// behind it; none if its corner does not fit, or its minor edge does not clear the
// surface in front.
std::optional<Arc> way_along(const Arc& arc, const std::vector<Piece>& before,
                             const std::vector<Piece>& behind, const Corner& corner) {
  const auto whole = tip_arc(arc, corner.re_mm);
  if (!whole) return std::nullopt;
  const auto course = around(*whole);
  const double to = free_mm(course, behind, corner);
  const auto back = backwards({to, course.at});
  const double from = free_mm(back, before, corner);
  if (!(from > 0) || from < free_mm(back, before, {corner.re_mm}) - kStands_mm)
    return std::nullopt;
  return Arc{back.at(from), course.at(to), whole->centre, whole->convex};
}

// Start of the path along an arc: down a slope onto its beginning, or from above, as the
// drawn surfaces allow.
std::optional<Point> beginning(const Point& to, double above_mm,
                               const std::vector<Piece>& pieces, const Corner& corner) {
  if (const auto slope = slope_onto(to, above_mm, pieces, corner)) return slope;
  if (comes_in({to}, pieces, corner)) return to;
  return std::nullopt;
}

void arc(Site& site, const OperationPlan& o, const FixedTool& tool, const Place& p) {
  const auto& s = p.surface();
  const auto& cut = *cut_of(site, s);
  const auto drawn = drawn_arc(site, s);
  if (!planning::cleared(site.part, site.setup, s.index)) {
    site.refuse(o.id, say("arc {} falls towards the chuck by more than the {:.4g} "
                          "deg that profiling tools are taken to clear",
                          s.id, units::deg_from_rad(part::kProfilingClears_rad)));
    return;
  }
  const Corner corner{tool.re_mm, part::kProfilingClears_rad};
  const auto before = drawn_before(site, p.side, p.k);
  auto behind = drawn_behind(site, p.side, p.k);
  if (const auto way = way_along(drawn, before, behind, corner))
    tell_jaws(site, p.k, o.id, way->to.z_mm);
  behind.push_back(wall(site.root_z));
  auto all = before;
  all.insert(all.end(), behind.begin(), behind.end());
  double left = cut.depth_mm;
  for (std::size_t i = 0; i < o.passes.size(); ++i) {
    left = i + 1 == o.passes.size() ? 0 : left - o.passes[i].ap_mm;
    Arc raised = drawn;
    for (Point* q : {&raised.from, &raised.to, &raised.centre}) q->h_mm += left;
    const auto way = way_along(raised, before, behind, corner);
    if (!way) {
      site.refuse(o.id, say("arc {} of {:g} mm between what is beside it does not "
                            "take the tool, of a corner of {:g} mm",
                            s.id, cut.radius_mm, tool.re_mm));
      return;
    }
    const auto from = beginning(way->from, site.above(p.side), all, corner);
    if (!from) {
      site.refuse(
          o.id,
          say("no tool gets to the beginning of arc {} past what is beside it", s.id));
      return;
    }
    if (unfaced(site, o, s, from->z_mm + 2 * tool.re_mm)) return;
    site.approach(p.side, *from, way->from, tool.re_mm);
    site.to(Kind::feed, p.side, way->from);
    site.arc(p.side, way->to, way->centre, way->convex, true);
    site.lift(p.side);
  }
  p.surface().h0 = drawn.from.h_mm;
  p.surface().h1 = drawn.to.h_mm;
}

// Around the rounded edge at the front of an element, which a way of the tip makes; comes up
// to the face on a slope of 45 deg.
void round_edge(Site& site, const Place& p, const Arc& way) {
  const double from = planning::before_rounding_mm(kBefore_mm);
  site.approach(p.side, {way.from.h_mm - from, way.from.z_mm + from});
  site.to(Kind::feed, p.side, way.from);
  site.arc(p.side, way.to, way.centre, true, true);
}

// Along the chamfer at the front of an element, or around its edge, the deepest cut last.
void chamfer(Site& site, const OperationPlan& o, const FixedTool& tool, const Place& p) {
  const auto& s = p.surface();
  const auto line = finished_line(site, p.side, s);
  const auto n = normal(line[0], line[1]);
  const auto round = rounding(site, p.side, s, tool.re_mm);
  double left = s.front->radial_mm;
  const double step = left / static_cast<double>(o.passes.size());
  for (std::size_t i = 0; i < o.passes.size(); ++i) {
    left = i + 1 == o.passes.size() ? 0 : left - step;
    if (round) {
      Arc raised = *round;
      for (Point* q : {&raised.from, &raised.to, &raised.centre}) q->h_mm += left;
      round_edge(site, p, raised);
      site.lift(p.side);
      continue;
    }
    const auto at = [&](const Point& q, double beyond) {
      return moved_along(tip({q.h_mm + left, q.z_mm}, n, tool.re_mm), n, beyond);
    };
    site.approach(p.side, at(line[0], -kBefore_mm));
    site.to(Kind::feed, p.side, at(line[1], tool.re_mm + kBehind_mm));
    site.lift(p.side);
  }
}

void part_off(Site& site, const OperationPlan& o) {
  const double L = part::length_mm(site.part.drawing), w = o.passes[0].ap_mm;
  const double z = -L - *site.part.drawing.stock.parted_mm - w;
  site.approach(site.outer, {site.outer.stock_h + kAbove_mm, z});
  site.to(Kind::feed, site.outer, {site.part.drawing.stock.inner_mm / 2, z});
  site.rapid(site.outer.stock_h + kClear_mm, z);
}

}  // namespace

FixedUse use_of(const Site& site, const OperationPlan& o) {
  return fixed_tool_of(site, o).use;
}

void fixed(Site& site, std::size_t operation) {
  const auto& o = site.answer().operations[operation];
  const auto& tool = fixed_tool_of(site, o);
  switch (tool.use) {
    case FixedUse::centring:
    case FixedUse::drilling:
      return drill(site, o, tool);
    case FixedUse::counterboring:
      return counterbore(site, o);
    case FixedUse::countersinking:
      return countersink(site, o, tool);
    case FixedUse::reaming:
      return through_hole(site, o, Kind::feed);
    case FixedUse::tapping:
      return through_hole(site, o, Kind::thread);
    case FixedUse::parting:
      return part_off(site, o);
    case FixedUse::grooving:
      return groove(site, o, place_of(site, o.on[0]));
    case FixedUse::threading:
      return thread(site, o, place_of(site, o.on[0]));
    case FixedUse::knurling:
      return knurl(site, o, place_of(site, o.on[0]));
    case FixedUse::profiling: {
      const auto place = place_of(site, o.on[0]);
      return cut_of(site, place.surface()) ? arc(site, o, tool, place)
                                           : chamfer(site, o, tool, place);
    }
  }
}

}  // namespace turnwright::nc
