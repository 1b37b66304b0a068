#include "hole_operations.hpp"

#include <algorithm>
#include <cmath>

#include "base/say.hpp"
#include "planning/clamping/centre_clearance.hpp"
#include "planning/paths/edges.hpp"
#include "planning/paths/programmed_faces.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::planning {
namespace fixed {
namespace {

// Eq. (2), down to a depth of the tip.
AuxiliaryOperation drilled(const Site& s, const Asked& a, const Fitted& f,
                           double tip_mm) {
  const double D = f.size_mm, n_cap = n_cap_rpm(s);
  const auto kc = cutting::kienzle_at(s.p.material, f.tool->gamma_deg);
  const double front = front_mm(s.p, s.setup, s.work);
  const double path = front + tip_mm;
  const auto way = drill_way(*f.tool, D, path, kBefore_mm);
  return at_best(s, f, {D}, n_cap, [&](const Fitted& at) {
    const Duty d{cutting::drill(kc, D, at.at.f_mm_rev, at.tool->point_deg),
                 std::min(units::spindle_rpm(at.at.vc_m_min, D), n_cap), D};
    const double vf = at.at.f_mm_rev * d.n_rpm;
    return operation(s, a, at, {pass_of(d, D / 2, way.fed_mm / vf)},
                     {kBefore_mm / vf, way.rapid_mm, true, 0, 0}, {d});
  });
}

// Whether a setup makes the drawn centre hole of an end: the first that faces it, else the
// first that leaves it free.
bool makes_centre(const PreparedPart& p, std::size_t setup, part::End end) {
  for (const bool faces : {true, false})
    for (std::size_t s = 0; s < p.work.setups.size(); ++s)
      if (free_end(p, s) == end && (!faces || p.work.setups[s].end_face))
        return s == setup;
  return false;
}

// The bores of a bar that open to an end: how deep, and the narrowest diameter.
struct Hole {
  double depth_mm = 0, least_mm = INFINITY;
  std::string first;      // the outermost bore
  double drilled_mm = 0;  // of the innermost if it is a hole: the drill's diameter
  double beyond_mm = 0;   // diameter of reamers and taps whose leads go beyond the bores
  double extra_mm = 0;    // that the drill goes beyond the bores for them
  /// Material left between the bores of both ends, or to the other end or its centre hole;
  /// the narrowest of the bores there.
  double rest_mm = 0, behind_mm = INFINITY;

  // Whether a drill's point, and the lead of a reamer or tap, stay clear of the drawn
  // surfaces behind, as of a thread of the other end; between bores from both ends each may
  // use half.
  bool spares_behind(const FixedTool& drill, double size_mm) const {
    if (rest_mm < kNoWall_mm) return std::max(size_mm, beyond_mm) <= behind_mm;
    const double tip = extra_mm + cutting::drill_point_mm(size_mm, drill.point_deg);
    return tip < (std::isfinite(behind_mm) ? rest_mm / 2 : rest_mm);
  }
};
Hole hole_from(const part::Drawing& d, part::End end) {
  Hole h;
  if (d.stock.inner_mm > 0) return h;
  const auto& centre = part::centre_at(d, part::opposite(end));
  h.rest_mm = part::length_mm(d) - (centre ? centre->depth_mm : 0);
  double needed = 0;  // by reamers and taps
  for (const auto& e : d.inner) {
    h.rest_mm -= e.length_mm;
    const double narrowest_mm =
        std::min(e.left_mm, e.right_mm) + 2 * to_middle_mm(d, e.id);
    if (e.from != end) {
      h.behind_mm = std::min(h.behind_mm, narrowest_mm);
      continue;
    }
    if (h.first.empty()) h.first = e.id;
    h.depth_mm += e.length_mm;
    h.least_mm = std::min(h.least_mm, narrowest_mm);
    h.drilled_mm = part::is_hole(e) ? e.cut->drilled_mm : 0;
    if (part::is_hole(e))
      needed = std::max(needed, h.depth_mm + part::drilled_beyond_mm(*e.cut));
  }
  if (!(needed > h.depth_mm)) return h;
  double deep = 0;
  for (const auto& e : d.inner) {
    if (e.from != end) continue;
    deep += e.length_mm;
    if (part::is_hole(e) && deep + e.cut->lead_mm > h.depth_mm)
      h.beyond_mm = std::max(h.beyond_mm, e.cut->drawn.left_mm);
  }
  h.extra_mm = needed - h.depth_mm;
  h.depth_mm = needed;
  return h;
}

// Whether feed drive and spindle drive a drill and the jaws hold the part.
bool drives(const PreparedPart& p, std::size_t setup, const Fitted& f) {
  const double D_mm = f.size_mm;
  const auto ranges = cutting::speed_ranges(p.machine);
  const auto load = cutting::drill(cutting::kienzle_at(p.material, f.tool->gamma_deg),
                                   D_mm, f.at.f_mm_rev, f.tool->point_deg);
  const double n = std::clamp(units::spindle_rpm(f.at.vc_m_min, D_mm),
                              ranges.front().n_min_rpm, ranges.back().n_max_rpm);
  const double P_kW = units::shaft_power_kW(load.M_Nm, n);
  const auto grip =
      grip_forces(p, setup, Clamping::chuck, Stage::roughing, {load, n, D_mm});
  return load.Ff_N <= p.machine.feed_force_max_N &&
         P_kW <= cutting::available_kW(ranges, n, false) &&
         P_kW <= cutting::available_kW(ranges, n, true) && grip.needed_N <= grip.closed_N;
}

Asked drilling(const Hole& h, const OperationRequest* given) {
  return {FixedUse::drilling,
          to_translate("drill"),
          h.first,
          false,
          given,
          [h](const FixedTool& t, double size) {
            return (h.drilled_mm > 0 ? size == h.drilled_mm
                                     : size <= h.least_mm - 2 * kLeftToBore_mm) &&
                   h.depth_mm <= t.reach * size && h.spares_behind(t, size);
          }};
}

// Without a tool it is the cut of a groove or thread that it is on.
const OperationRequest* given_drilling(const PlanRequest& p, part::End end) {
  if (!p.operations) return nullptr;
  for (const auto& o : *p.operations)
    for (const auto& e : p.drawing.inner)
      if (o.kind == OperationKind::fixed && e.from == end &&
          p.setups[o.setup].hold != end &&
          (o.tool ? names_tool(p, o, FixedUse::drilling) : !e.cut || part::is_hole(e)) &&
          std::find(o.on.begin(), o.on.end(), e.id) != o.on.end())
        return &o;
  return nullptr;
}

Fitted fitted_drill(const PreparedPart& p, std::size_t setup, const Asked& a) {
  return fitted_if(p, a, [&](const Fitted& f) { return drives(p, setup, f); });
}

// Whether a given operation asks for another depth, or more passes, than the one that
// follows from the drawing; refuses it then.
bool asks_for_other_passes(const Site& s, const Asked& a, double ap_mm) {
  if (!a.given) return false;
  const auto& c = a.given->conditions;
  if (c.passes.value_or(1) == 1 && std::abs(c.ap_mm.value_or(ap_mm) - ap_mm) < 1e-6)
    return false;
  refuse(s, a, say("it cuts {:.4g} mm deep in one pass", ap_mm));
  return true;
}

// A reamer or a tap goes through its hole to its lead beyond, and back at the same feed:
// in the cut both ways.
AuxiliaryOperation through_hole(const Site& s, const Asked& a, const Fitted& f,
                                const CutElement& e, double n_cap,
                                const std::function<cutting::Load(const Fitted&)>& load) {
  const double z0 = e.around.z0, front = e.around.front;
  const double from = hole_start_mm(z0, front) + before_hole_mm(e.cut),
               before = from - z0;
  return at_best(s, f, {f.size_mm}, n_cap, [&](const Fitted& at) {
    const Duty d{load(at),
                 std::min(units::spindle_rpm(at.at.vc_m_min, at.size_mm), n_cap),
                 at.size_mm};
    const double vf = at.at.f_mm_rev * d.n_rpm;
    return operation(s, a, at, {pass_of(d, e.cut.depth_mm, 2 * e.length_mm / vf)},
                     {2 * (before + e.cut.lead_mm) / vf,
                      2 * std::max(0.0, front + kBefore_mm - from), true, 0, 0},
                     {d});
  });
}

// A chamfer of a hole, at its beginning or where it leaves the part.
struct Sink {
  const std::string& id;
  part::Chamfer chamfer;
  double hole_mm = 0, from_mm = 0;  // drawn, and what is open when the countersink comes
  double room_mm = INFINITY;        // in the bores before it
  double inside_mm = 0;             // behind the material of the end
};

// Eq. (8).
void countersink(Site& s, const Sink& k) {
  const double D = k.hole_mm + 2 * k.chamfer.radial_mm, from_mm = k.from_mm;
  const Asked a{FixedUse::countersinking,
                to_translate("countersink"),
                k.id,
                false,
                given_on(s, k.id, FixedUse::countersinking),
                [&](const FixedTool& t, double size) {
                  return size >= D && size <= k.room_mm &&
                         part::fits_countersink(k.chamfer, t.point_deg);
                }};
  const auto f = fitted(s.p, a);
  if (!f.tool)
    return refuse(s, a,
                  say("no countersink of the tools is for {}, of the chamfer's "
                      "angle, at least {:g} mm in diameter and passes the bores "
                      "before it",
                      s.p.material.name, D));
  if (asks_for_other_passes(s, a, (D - from_mm) / 2)) return;
  const auto kc = cutting::kienzle_at(s.p.material, f.tool->gamma_deg);
  const double in = cutting::drill_point_mm(D, f.tool->point_deg), fed = kBefore_mm + in;
  const double cut = in - cutting::drill_point_mm(from_mm, f.tool->point_deg);
  const double n_cap = n_cap_rpm(s);
  s.out.after.push_back(at_best(s, f, {D}, n_cap, [&](const Fitted& at) {
    const Duty duty{cutting::ream(kc, D, from_mm, at.at.f_mm_rev, at.tool->edges,
                                  at.tool->point_deg / 2),
                    std::min(units::spindle_rpm(at.at.vc_m_min, D), n_cap), D};
    const double vf = at.at.f_mm_rev * duty.n_rpm;
    return operation(s, a, at, {pass_of(duty, (D - from_mm) / 2, cut / vf)},
                     {(fed - cut) / vf, 2 * k.inside_mm + fed, true, 0, 0}, {duty});
  }));
}

// The chamfer where a hole begins.
void add_countersinking(Site& s, const CutElement& e) {
  const auto& c = e.around.front_chamfer;
  if (!(c.axial_mm > 0)) return;
  const Asked a{
      FixedUse::countersinking, to_translate("countersink"), e.id, false, nullptr, {}};
  if (unfaced(s, a, e, e.around.z0 + kBefore_mm)) return;
  countersink(s, {e.id, c, -2 * e.around.h0, part::opened_mm(e.cut),
                  part::way_in_mm(s.p.drawing, e.index) - 2 * kAboveBore_mm,
                  e.around.front - e.around.z0});
}

// Eq. (7).
void add_reaming(Site& s, const CutElement& e) {
  const double D = e.cut.drawn.left_mm, deep = e.length_mm + e.cut.lead_mm;
  const Asked a{FixedUse::reaming,
                to_translate("ream"),
                e.id,
                false,
                given_on(s, e.id, FixedUse::reaming),
                [&](const FixedTool& t, double size) {
                  return size == D && deep <= t.reach * D && t.lead <= e.cut.lead_mm;
                }};
  const auto f = fitted(s.p, a);
  if (!f.tool)
    return refuse(s, a,
                  say("no reamer of the tools is for {}, {:g} mm in diameter and "
                      "reaches {:g} mm deep",
                      s.p.material.name, D, deep));
  if (asks_for_other_passes(s, a, e.cut.depth_mm)) return;
  const auto kc = cutting::kienzle_at(s.p.material, f.tool->gamma_deg);
  s.out.after.push_back(through_hole(s, a, f, e, n_cap_rpm(s), [&](const Fitted& at) {
    return cutting::ream(kc, D, e.cut.drilled_mm, at.at.f_mm_rev, at.tool->edges);
  }));
}

// Eq. (7).
void add_tapping(Site& s, const CutElement& e) {
  const double d = e.cut.drawn.left_mm, P = e.cut.pitch_mm;
  const double deep = e.length_mm + e.cut.lead_mm;
  const Asked a{FixedUse::tapping,
                to_translate("tap"),
                e.id,
                false,
                given_on(s, e.id, FixedUse::tapping),
                [&](const FixedTool& t, double) {
                  return catalogue::thread_of(t, d, P) && deep <= t.reach * d &&
                         t.lead * P <= e.cut.lead_mm * (1 + kBeyondRounding);
                }};
  auto f = fitted(s.p, a);
  if (!f.tool)
    return refuse(s, a,
                  say("no tap of the tools is for {} and a thread of {:g} mm with "
                      "a pitch of {:g} mm, {:g} mm deep",
                      s.p.material.name, d, P, deep));
  if (asks_for_other_passes(s, a, e.cut.depth_mm)) return;
  if (a.given && std::abs(a.given->conditions.f_mm_rev.value_or(P) / P - 1) > 1e-9)
    return refuse(s, a, say("its feed is its pitch, {:g} mm", P));
  f.size_mm = d;
  f.at.f_mm_rev = P;
  if (f.at.window) f.at.window->f_mm_rev = {P, P};
  const auto kc = cutting::kienzle_at(s.p.material, f.tool->gamma_deg);
  const double n_cap = std::min(n_cap_rpm(s), s.p.machine.rapid_mm_min / P);
  s.out.after.push_back(through_hole(s, a, f, e, n_cap, [&](const Fitted& at) {
    return cutting::tap(kc, d, P, e.cut.depth_mm, at.tool->lead, at.tool->edges);
  }));
}

}  // namespace

bool needs_centre(const PreparedPart& p, std::size_t setup, Clamping clamping) {
  const auto end = free_end(p, setup);
  if (part::centre_at(p.drawing, end)) return makes_centre(p, setup, end);
  return has_live_centre(clamping) && !(free_bore_mm(p, setup) > 0);
}

// Without any centre drill among the tools the stock is assumed to come centred, where the
// drawing asks for none.
void add_centre(Site& s, const char* face, double end_mm) {
  const auto& drawn = part::centre_at(s.p.drawing, free_end(s.p, s.setup));
  if (!drawn && std::none_of(s.p.fixed_tools.begin(), s.p.fixed_tools.end(),
                             [](const auto& t) { return t.use == FixedUse::centring; }))
    return;
  Asked a{FixedUse::centring,
          to_translate("centre"),
          face,
          false,
          given_on(s, face),
          [&](const FixedTool& t, double size) {
            return drawn ? t.form == drawn->form && size == drawn->diameter_mm
                         : t.form == 'A' && size <= kCentreShare * end_mm;
          }};
  const auto f = fitted(s.p, a);
  if (f.tool)
    s.out.before.push_back(drilled(s, a, f, catalogue::tip_depth_mm(*f.tool, f.size_mm)));
  else
    refuse(s, a,
           drawn ? say("no centre drill of the tools is for {} and {}", s.p.material.name,
                       part::designation(*drawn))
                 : say("no centre drill of the tools is for {} and an end of {:g} mm",
                       s.p.material.name, end_mm));
}

/// The drill that is missing: of the hole's diameter, or with room behind it for a bar.
struct MissingDrill {
  double size_mm = 0;
  bool exact = true;
};
MissingDrill missing_drill(const Hole& h) {
  if (h.drilled_mm > 0) return {h.drilled_mm};
  const double most_mm = h.least_mm - 2 * kLeftToBore_mm;
  if (most_mm > 0) return {most_mm, false};
  return {h.least_mm};  // no bar follows in so narrow a bore
}

void add_drilling(Site& s, part::End end) {
  const auto h = hole_from(s.p.drawing, end);
  if (h.first.empty()) return;
  const auto a = drilling(h, given_drilling(s.p, end));
  const auto f = fitted_drill(s.p, s.setup, a);
  const auto missing = missing_drill(h);
  if (f.tool)
    s.out.before.push_back(
        drilled(s, a, f,
                drilled_depth_mm(s.p, s.setup, end, f.tool->reach * f.size_mm) +
                    cutting::drill_point_mm(f.size_mm, f.tool->point_deg)));
  else
    refuse(
        s, a,
        say("none of the drills is for {}, {}{:g} mm in diameter and long enough for "
            "{:g} mm{}",
            s.p.material.name, missing.exact ? "" : tr("at most "), missing.size_mm,
            h.depth_mm,
            h.rest_mm < kNoWall_mm && !std::isfinite(h.behind_mm)
                ? ""
                : tr(", with a point, and a reamer or tap behind it, that stay clear of "
                     "what lies "
                     "behind the hole")));
}

// Eq. (10).
void add_counterbore(Site& s, std::size_t index) {
  const auto& e = s.p.drawing.inner[index];
  const double D = e.left_mm, front = front_mm(s.p, s.setup, s.work);
  const auto way = counterbore_way(s.p.drawing, index, front);
  const Asked a{FixedUse::counterboring,
                to_translate("counterbore"),
                e.id,
                false,
                given_on(s, e.id, FixedUse::counterboring),
                [&](const FixedTool& t, double size) {
                  return size == D && -way.to_mm <= t.reach * D;
                }};
  const auto f = fitted(s.p, a);
  if (!f.tool)
    return refuse(s, a,
                  say("no flat drill of the tools is for {}, {:g} mm in diameter "
                      "and reaches {:g} mm deep",
                      s.p.material.name, D, -way.to_mm));
  if (asks_for_other_passes(s, a, e.cut->depth_mm)) return;
  const auto kc = cutting::kienzle_at(s.p.material, f.tool->gamma_deg);
  const double n_cap = n_cap_rpm(s);
  const double cut = way.from_mm - way.to_mm;
  s.out.before.push_back(at_best(s, f, {D}, n_cap, [&](const Fitted& at) {
    const Duty duty{cutting::ream(kc, D, e.cut->drilled_mm, at.at.f_mm_rev,
                                  at.tool->edges, at.tool->point_deg / 2),
                    std::min(units::spindle_rpm(at.at.vc_m_min, D), n_cap), D};
    const double vf = at.at.f_mm_rev * duty.n_rpm;
    return operation(
        s, a, at, {pass_of(duty, e.cut->depth_mm, cut / vf)},
        {kBefore_mm / vf, 2 * (front - way.from_mm) + kBefore_mm + cut, true, 0, 0},
        {duty});
  }));
}

void add_closing_chamfer(Site& s, std::size_t inner) {
  const auto& e = s.p.drawing.inner[inner];
  countersink(s, {e.id, *part::closing_chamfer(e), e.left_mm, e.left_mm});
}

void add_hole_work(Site& s, const CutElement& e) {
  add_countersinking(s, e);
  if (e.cut.kind == part::CutKind::thread)
    add_tapping(s, e);
  else if (!e.cut.flat && e.cut.depth_mm > 0)
    add_reaming(s, e);
}

}  // namespace fixed

double hole_start_mm(double begins_mm, double front_mm) {
  return begins_mm > -kNoWall_mm ? std::max(begins_mm, front_mm) : begins_mm;
}

double before_hole_mm(const part::Cut& hole) {
  return std::max(kBefore_mm, kRunInPitches * hole.pitch_mm);
}

CounterboreWay counterbore_way(const part::Drawing& d, std::size_t index,
                               double front_mm) {
  CounterboreWay way{front_mm};
  for (std::size_t i = 0; i <= index; ++i) {
    const auto& e = d.inner[i];
    if (e.from != d.inner[index].from) continue;
    way.to_mm -= e.length_mm;
    if (part::is_counterbore(e) && i < index) way.from_mm = way.to_mm;
  }
  return way;
}

double drilled_depth_mm(const PreparedPart& p, std::size_t setup, part::End end,
                        double longest_mm) {
  const auto h = fixed::hole_from(p.drawing, end);
  const bool meets = std::isfinite(h.behind_mm);
  bool open = false;  // what lies behind
  for (std::size_t s = 0; s < setup; ++s) {
    const auto& work = p.work.setups[s];
    open = open || (meets ? !work.bores.empty() : work.end_face);
  }
  if (h.drilled_mm > 0 || open || !(h.rest_mm < kNoWall_mm)) return h.depth_mm;
  double largest = 0;
  for (const auto& t : p.tools) largest = std::max(largest, t.re_mm);
  return std::clamp(h.depth_mm + 2 * largest + kBehind_mm, h.depth_mm,
                    std::max(h.depth_mm, longest_mm));
}

double drilled_mm(const PreparedPart& p, part::End end) {
  const auto h = fixed::hole_from(p.drawing, end);
  if (h.first.empty()) return 0;
  const auto a = fixed::drilling(h, fixed::given_drilling(p, end));
  const auto setup = setup_of(p, h.first);
  return (setup ? fixed::fitted_drill(p, *setup, a) : fixed::fitted(p, a)).size_mm;
}

double before_boring_mm(const part::Drawing& d, std::size_t index, double drilled_mm) {
  double D = drilled_mm;
  if (part::is_hole(d.inner[index])) return D;
  for (std::size_t i = index + 1; i < d.inner.size(); ++i)
    if (d.inner[i].from == d.inner[index].from && part::is_counterbore(d.inner[i]))
      D = std::max(D, d.inner[i].left_mm);
  return D;
}

}  // namespace turnwright::planning
