#include "catalogue_operations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "base/say.hpp"
#include "hole_operations.hpp"
#include "milled_operations.hpp"
#include "planning/clamping/positions.hpp"
#include "planning/paths/edges.hpp"
#include "planning/values/most_passes.hpp"
#include "planning/values/readable.hpp"
#include "turnwright/base/dual.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/cutting/fixed.hpp"

namespace turnwright::planning {
namespace {

using namespace fixed;

constexpr int kLeastInfeeds = 4;  // of a thread

cutting::Load load_of(const Fitted& f, const PreparedPart& p, double b_mm, double D_mm) {
  return cutting::plunge(cutting::kienzle_at(p.material, f.tool->gamma_deg),
                         catalogue::thrust_of(p.material), b_mm, f.at.f_mm_rev, D_mm);
}

// A facing sweep between two diameters at constant surface speed.
double sweep_min(double path_mm, double D_small, double D_large,
                 const catalogue::FixedConditions& at, double n_cap) {
  const cutting::Sweep<double> sweep{path_mm, D_small, D_large, D_small < D_large,
                                     !(D_small > 0)};
  return cutting::duty(sweep, at.vc_m_min, at.f_mm_rev, at.T_min, n_cap, 1.0).time_min;
}

// Loads of a blade's plunge at its largest and its smallest diameter.
std::vector<Duty> plunging(const Site& s, const Fitted& f, double D_small,
                           double D_large) {
  std::vector<Duty> duties;
  for (const double D : {D_large, D_small})
    if (D > 0)
      duties.push_back({load_of(f, s.p, f.size_mm, D),
                        std::min(units::spindle_rpm(f.at.vc_m_min, D), n_cap_rpm(s)), D,
                        true});
  return duties;
}

// The operation of a blade that plunges `plunges` times from one diameter to another,
// Eq. (3).  `way.fed_min` holds the length [mm] that each plunge feeds in the air.
AuxiliaryOperation plunged(const Site& s, const Asked& a, const Fitted& f, double D_small,
                           double D_large, int plunges, const Way& way) {
  const double n_cap = n_cap_rpm(s), depth = (D_large - D_small) / 2;
  std::vector<double> diameters{D_large};
  if (D_small > 0) diameters.push_back(D_small);
  return at_best(s, f, diameters, n_cap, [&](const Fitted& at) {
    const auto duties = plunging(s, at, D_small, D_large);
    const double t = sweep_min(depth, D_small, D_large, at.at, n_cap);
    const std::vector<Pass> passes(static_cast<std::size_t>(plunges),
                                   pass_of(duties[0], at.size_mm, t));
    auto fed = way;
    fed.fed_min *= plunges / (at.at.f_mm_rev * duties[0].n_rpm);
    return operation(s, a, at, passes, fed, duties);
  });
}

// Rapid travel [mm] from outside the stock, or from the mouth of a bore, to an element and
// back.
double down_and_back_mm(const CutElement& e) {
  const auto& s = e.around;
  if (e.inner) return 2 * (s.front + kClear_mm - s.z1);
  return 2 * (s.stock_h + kClear_mm - std::max(s.h0, s.h1) - kAbove_mm);
}
double above_mm(const CutElement& e) { return e.inner ? kAboveBore_mm : kAbove_mm; }

// The given operation that cuts an element: not the drill that begins its end's bores there.
const OperationRequest* given_cut(const Site& s, const std::string& surface) {
  if (!s.p.operations) return nullptr;
  for (const auto& o : *s.p.operations)
    if (is_given_on(s, o, surface) && !names_tool(s.p, o, FixedUse::drilling)) return &o;
  return nullptr;
}

Asked asked(const Site& s, const CutElement& e, FixedUse use, const char* does,
            std::function<bool(const FixedTool&, double)> fits) {
  return {use,
          does,
          e.id,
          e.inner,
          given_cut(s, e.id),
          [&e, fits](const FixedTool& t, double size) {
            return (!e.inner || t.min_bore_mm <= e.bored_mm) && fits(t, size);
          }};
}

int times(double whole, double part) {
  return std::max(1, counted_passes(std::ceil(whole / part - 1e-9)));
}

// The given number of passes, or the one that follows from a given depth; nothing if the
// two contradict, or if there are too many.
std::optional<int> passes_of(const Site& s, const Asked& a, int otherwise,
                             const std::function<int(double)>& at_depth) {
  const auto c = a.given ? a.given->conditions : Conditions{};
  const int least = c.ap_mm ? at_depth(*c.ap_mm) : 1;
  const int n = c.passes.value_or(c.ap_mm ? least : otherwise);
  if (n < least)
    refuse(s, a, say("{} passes of {:g} mm are too few", n, *c.ap_mm));
  else if (n > kMostPasses)
    refuse(s, a, say("it would take more than {} passes", kMostPasses));
  else
    return n;
  return std::nullopt;
}

// Whether machine, jaws and tool bear a blade at the ends of its plunge.
bool bears(const Site& s, const Fitted& f, const CutElement& e) {
  return std::ranges::all_of(
      limits(s, *f.tool, plunging(s, f, e.small_mm, e.large_mm)),
      [](const ConstraintValue& c) { return c.margin >= -kBeyondRounding; });
}

void add_groove(Site& s, const CutElement& e) {
  auto a = asked(s, e, FixedUse::grooving, to_translate("groove"),
                 [&](const FixedTool& t, double size) {
                   return size <= e.length_mm * (1 + 1e-9) && e.cut.depth_mm <= t.reach;
                 });
  const auto f = fitted_if(s.p, a, [&](const Fitted& each) { return bears(s, each, e); });
  if (!f.tool)
    return refuse(s, a,
                  say("no blade of the tools is for {}, at most {:g} mm wide and "
                      "reaches {:g} mm deep",
                      s.p.material.name, e.length_mm, e.cut.depth_mm));
  const auto plunges = passes_of(s, a, times(e.length_mm, f.size_mm), [&](double ap) {
    return times(e.length_mm, std::min(ap, f.size_mm));
  });
  if (plunges && *plunges * f.size_mm < e.length_mm * (1 - 1e-9))
    return refuse(s, a,
                  say("{} plunges of a blade of {:g} mm are less than its width, "
                      "{:g} mm",
                      *plunges, f.size_mm, e.length_mm));
  if (!plunges) return;
  const double n = *plunges, step = n > 1 ? (e.length_mm - f.size_mm) / (n - 1) : 0;
  const double back = e.cut.depth_mm + above_mm(e);
  const bool stands =
      thread_room(s.p, s.setup, {e.inner, e.index}, e.around.h0).stands_behind;
  Way way{above_mm(e) + (stands ? kBehind_mm / n : 0),
          n * (down_and_back_mm(e) + back) + (e.inner ? 0 : (n - 1) * step), e.inner,
          e.around.z1, e.around.z1 + (n - 1) * step};
  const auto rims = rims_of(s.p, s.setup, {e.inner, e.index});
  for (const auto& c : {rims.front, rims.back}) {
    if (!c) continue;
    way.fed_min += (above_mm(e) + std::hypot(c->axial_mm, c->radial_mm)) / n;
    way.rapid_mm += down_and_back_mm(e) + above_mm(e) + c->radial_mm;
  }
  if (e.inner) way.from_mm = way.to_mm = -e.around.h0 - kAboveBore_mm;
  s.out.after.push_back(plunged(s, a, f, e.small_mm, e.large_mm, *plunges, way));
}

// What an inner thread lacks beside a threading tool.
std::string not_tapped(double bored_mm) {
  return say(
      " in a bore of {:g} mm, and no tap that goes as deep with its lead, and has its "
      "drill, makes it: {}",
      bored_mm,
      tr("a tapped thread is the innermost bore of its end or has a hole of its drill's "
         "diameter behind it, and no edge but a chamfer that a countersink cuts"));
}

// Eq. (4).
void add_thread(Site& s, const CutElement& e) {
  const double P = e.cut.pitch_mm;
  auto a = asked(s, e, FixedUse::threading, to_translate("thread"),
                 [&](const FixedTool& t, double) {
                   return t.pitch_mm.lower <= P && P <= t.pitch_mm.upper;
                 });
  auto f = fitted(s.p, a);
  if (!f.tool)
    return refuse(s, a,
                  say("no threading tool of the tools is for {} and a pitch of "
                      "{:g} mm{}",
                      s.p.material.name, P, e.inner ? not_tapped(e.bored_mm) : ""));
  if (a.given && std::abs(a.given->conditions.f_mm_rev.value_or(P) / P - 1) > 1e-9)
    return refuse(s, a, say("its feed is its pitch, {:g} mm", P));
  f.at.f_mm_rev = P;
  if (f.at.window) f.at.window->f_mm_rev = {P, P};
  const double D = e.cut.drawn.left_mm;
  const auto count =
      passes_of(s, a, std::max(kLeastInfeeds, times(f.tool->passes_per_mm * P, 1)),
                [&](double ap) { return times(sqr(e.cut.depth_mm), sqr(ap)); });
  if (!count) return;
  const auto room = thread_room(s.p, s.setup, {e.inner, e.index}, e.root_h());
  const auto way_in = run_in_mm(room, P);
  if (!way_in && room.rising_mm > kRunInPitches * P)
    return refuse(s, a,
                  say("its run-in would cut {:.3g} mm of what rises to it in front, "
                      "more than three pitches",
                      room.rising_mm));
  if (!way_in) {
    const auto [has, needs] =
        readable_apart(room.before_mm, least_run_in_mm(room, P) + P / 2);
    return refuse(s, a,
                  say("its tool has {} mm to come in behind what is higher than "
                      "the thread's root, and needs {} mm",
                      has, needs));
  }
  const double run_in = *way_in;
  if (unfaced(s, a, e, e.around.z0 + run_in)) return;
  const auto kc = cutting::kienzle_at(s.p.material, f.tool->gamma_deg);
  const double path = e.length_mm - (room.stands_behind ? P : 0);
  const auto infeeds = cutting::thread_infeeds(kc, catalogue::thrust_of(s.p.material),
                                               e.cut.depth_mm, *count, D);
  const double n_cap = std::min(n_cap_rpm(s), s.p.machine.rapid_mm_min / P);
  s.out.after.push_back(at_best(s, f, {D}, n_cap, [&](const Fitted& at) {
    const double n = std::min(units::spindle_rpm(at.at.vc_m_min, D), n_cap);
    std::vector<Pass> passes;
    std::vector<Duty> duties;
    Way way{*count * run_in / (P * n), down_and_back_mm(e), e.inner, e.around.z0 + run_in,
            e.around.z0 + run_in};
    if (e.inner) way.from_mm = way.to_mm = -e.around.h0 - kAboveBore_mm;
    double deep = 0;
    for (const auto& infeed : infeeds) {
      duties.push_back({infeed.load, n, D, true});
      passes.push_back(pass_of(duties.back(), infeed.depth_mm, path / (P * n)));
      deep += infeed.depth_mm;
      way.rapid_mm += 2 * (above_mm(e) + deep) + run_in + path;
    }
    return operation(s, a, at, std::move(passes), way, duties);
  }));
}

// Eq. (11).
void add_knurl(Site& s, const CutElement& e) {
  const double t = e.cut.pitch_mm;
  const auto room = thread_room(s.p, s.setup, {e.inner, e.index}, e.root_h());
  const auto way_of = [&](double width) {
    return knurl_way(room, e.around.z0, e.around.z1, width);
  };
  auto a = asked(s, e, FixedUse::knurling, to_translate("knurl"),
                 [&](const FixedTool& tool, double width) {
                   return tool.pitch_mm.lower <= t && t <= tool.pitch_mm.upper &&
                          way_of(width);
                 });
  const auto f = fitted(s.p, a);
  if (!f.tool)
    return refuse(s, a,
                  say("no knurling tool of the tools is for {} and a pitch of "
                      "{:g} mm, with a wheel that has room on {:g} mm",
                      s.p.material.name, t, e.length_mm));
  const auto count = passes_of(s, a, 1, [](double) { return 1; });
  if (!count) return;
  if (*count > 1) return refuse(s, a, tr("it is pressed in one pass"));
  const KnurlWay along_z = *way_of(f.size_mm);
  const double from = along_z.from_mm, to = along_z.to_mm;
  if (unfaced(s, a, e, from + f.size_mm)) return;
  const double D = e.cut.drawn.left_mm, n_cap = n_cap_rpm(s);
  const double depth = e.cut.depth_mm, along = from - to;
  s.out.after.push_back(at_best(s, f, {D}, n_cap, [&](const Fitted& at) {
    const Duty d{{}, std::min(units::spindle_rpm(at.at.vc_m_min, D), n_cap), D, true};
    const double vf = at.at.f_mm_rev * d.n_rpm;
    const Way way{kAbove_mm / vf, down_and_back_mm(e) + depth + kAbove_mm + along, false,
                  from, to};
    return operation(s, a, at, {pass_of(d, f.size_mm, (depth + along) / vf)}, way, {d});
  }));
}

// Inclination of an arc at its end towards the chuck.
double end_rad(const CutElement& e) {
  const auto& s = e.around;
  const bool left = s.mirrored;
  const double a = (left ? e.cut.drawn.left_mm : e.cut.drawn.right_mm) / 2;
  const double b = (left ? e.cut.drawn.right_mm : e.cut.drawn.left_mm) / 2;
  const double length = s.z0 - s.z1, chord = std::hypot(length, b - a);
  const double half = std::asin(std::min(1.0, chord / (2 * e.cut.radius_mm)));
  return std::atan2(b - a, length) + (e.cut.convex ? -half : half);
}

// The corner rolls over the end of an arc unless something rises behind it.
bool ends_before_jaws(const Site& s, const Asked& a, const CutElement& e, double re_mm) {
  const double needed = re_mm * (1 - std::sin(end_rad(e)));
  const double left = e.around.z1 - e.around.root_z;
  const bool walled = e.around.touch_z == e.around.z1;
  if (walled || left >= needed - 1e-5) return true;
  const auto [has, needs] = readable_apart(left, needed);
  refuse(s, a,
         say("it ends {} mm before the jaws, its tool's corner needs {} mm: grip "
             "less",
             has, needs));
  return false;
}

// Equal passes of a profiling tool.
struct Profile {
  int passes = 1;
  double ap_mm = 0, D_mm = 0, path_mm = 0;
};

// `way.fed_min` holds the length [mm] that is fed in the air.
AuxiliaryOperation profiled(const Site& s, const Asked& a, const Fitted& f,
                            const Profile& p, const Way& way) {
  const double n_cap = n_cap_rpm(s);
  return at_best(s, f, {p.D_mm}, n_cap, [&](const Fitted& at) {
    const Duty d{load_of(at, s.p, p.ap_mm, p.D_mm),
                 std::min(units::spindle_rpm(at.at.vc_m_min, p.D_mm), n_cap), p.D_mm};
    const double vf = at.at.f_mm_rev * d.n_rpm;
    const std::vector<Pass> passes(static_cast<std::size_t>(p.passes),
                                   pass_of(d, p.ap_mm, p.path_mm / vf));
    auto fed = way;
    fed.fed_min /= vf;
    return operation(s, a, at, passes, fed, {d});
  });
}

// Eq. (5).
void add_arc(Site& s, const CutElement& e) {
  auto a = asked(s, e, FixedUse::profiling, to_translate("arc"),
                 [&](const FixedTool& t, double) {
                   return e.cut.convex || t.re_mm <= e.cut.radius_mm;
                 });
  const auto f = fitted(s.p, a);
  if (!f.tool)
    return refuse(s, a,
                  say("no profiling tool of the tools is for {}", s.p.material.name));
  const auto count = passes_of(s, a, times(e.cut.depth_mm, f.tool->ap_mm),
                               [&](double ap) { return times(e.cut.depth_mm, ap); });
  if (!count) return;
  const double D = e.large_mm, ap = e.cut.depth_mm / *count;
  if (ap > f.tool->ap_mm * (1 + 1e-9))
    return refuse(s, a,
                  say("{} passes of {:.4g} mm are deeper than the {:g} mm of {}", *count,
                      ap, f.tool->ap_mm, f.tool->id));
  if (unfaced(s, a, e, e.around.z0 + kBefore_mm)) return;
  if (!ends_before_jaws(s, a, e, f.tool->re_mm)) return;
  // Path of the tip, which runs round a centre beside that of the arc.
  const double path =
      e.cut.path_mm * (1 + (e.cut.convex ? 1 : -1) * f.tool->re_mm / e.cut.radius_mm);
  const double enters = std::sqrt(2) * kAbove_mm;  // down a slope
  const double from = e.around.z0 + kAbove_mm, to = e.around.z1 + kAbove_mm;
  s.out.after.push_back(
      profiled(s, a, f, {*count, ap, D, path},
               {*count * enters,
                *count * (down_and_back_mm(e) + kAbove_mm) + (*count - 1) * (from - to),
                false, from, to}));
}

// A chamfer or a rounded edge at the free end by a pass of its own, along its line in cuts as
// deep as the tool may; depth and forces are those across the line.
void add_chamfer(Site& s, std::size_t index, bool inner) {
  const auto& d = s.p.drawing;
  const auto& id = inner ? d.inner[index].id : d.outer[index].id;
  const Element element{inner, index};
  const auto c = *front_chamfer(s.p, s.setup, element);
  const auto around = surroundings(s.p, s.setup, s.clamping, s.work, element);
  const double bore = -2 * around.h0, D = inner ? bore + 2 * c.radial_mm : 2 * around.h0;
  const Asked a{
      FixedUse::profiling,
      to_translate("chamfer"),
      id,
      inner,
      given_cut(s, id),
      [&](const FixedTool& t, double) { return !inner || t.min_bore_mm <= bore; }};
  const auto f = fitted(s.p, a);
  if (!f.tool)
    return refuse(s, a,
                  say("no profiling tool of the tools is for {}{}", s.p.material.name,
                      inner ? say(" in a bore of {:g} mm", bore) : std::string()));
  const double chord = std::hypot(c.axial_mm, c.radial_mm);
  const double length =
      c.round ? std::numbers::pi / 2 * (c.axial_mm + f.tool->re_mm) : chord;
  // Of a rounded edge, R (sqrt 2 - 1).
  const double depth = c.round ? chord - c.axial_mm : c.axial_mm * c.radial_mm / chord;
  const auto passes = passes_of(s, a, times(depth, f.tool->ap_mm),
                                [&](double ap) { return times(depth, ap); });
  if (!passes) return;
  const int count = *passes;
  const double outside = inner ? around.front + kClear_mm : around.stock_h - around.h0;
  const double from = inner ? bore / 2 : around.z0 + kBefore_mm;
  s.out.after.push_back(profiled(
      s, a, f, {count, depth / count, D, length},
      {count * (kBefore_mm + beyond_edge_mm(c, false, f.tool->re_mm)),
       2 * (outside + kClear_mm) + (count - 1) * 2 * length, inner, from, from}));
}

void add_parting(Site& s) {
  const auto& stock = s.p.drawing.stock;
  const bool left = s.p.setups[s.setup].hold == part::End::left;
  const char* face = left ? "left" : "right";
  const double D = stock.outer_mm, hole = stock.inner_mm;
  // Room [mm] for the blade along the axis: from the jaws to the allowance that stays on
  // the part.
  const double jaw = root_z_mm(s.p, s.setup, s.clamping);
  const double room =
      (left ? -jaw : jaw - part::length_mm(s.p.drawing)) - *stock.parted_mm;
  Asked a{FixedUse::parting,
          "part",
          face,
          false,
          given_on(s, face),
          [&](const FixedTool& t, double size) {
            return size <= room && (D - hole) / 2 <= t.reach;
          }};
  if (s.clamping == Clamping::between_centres)
    return refuse(s, a, tr("a part between centres is not parted off"));
  const auto f = fitted(s.p, a);
  if (!f.tool)
    return refuse(s, a,
                  say("no blade of the tools is for {}, reaches {:g} mm deep and "
                      "fits between jaws and part, {:.4g} mm",
                      s.p.material.name, (D - hole) / 2, room));
  const double z = -part::length_mm(s.p.drawing) - *stock.parted_mm - f.size_mm;
  s.out.after.push_back(plunged(
      s, a, f, hole, D, 1,
      {kAbove_mm, kClear_mm - kAbove_mm + (D - hole) / 2 + kClear_mm, false, z, z}));
}

template <class Element>
void add_cut(Site& s, const Element& e, std::size_t index, bool inner,
             part::CutKind kind) {
  if (!e.cut || e.cut->kind != kind) return;
  const bool drilled = e.cut->drilled_mm > 0;
  if (s.p.operations && !drilled && !given_cut(s, e.id)) {
    s.out.conflicts.push_back(
        {"operations", setup_label(s.setup), 0, 0, "",
         say("{} has no operation of kind \"fixed\": only its blank would be made",
             e.id)});
    return;
  }
  const auto& ends = part::is_groove(e) ? e.cut->core : e.cut->drawn;
  const auto [low, high] =
      std::minmax({e.left_mm, e.right_mm, ends.left_mm, ends.right_mm});
  const CutElement c{e.id,
                     *e.cut,
                     inner,
                     index,
                     e.length_mm,
                     low,
                     high,
                     std::min(e.left_mm, e.right_mm),
                     surroundings(s.p, s.setup, s.clamping, s.work, {inner, index})};
  switch (kind) {
    case part::CutKind::groove:
      return add_groove(s, c);
    case part::CutKind::thread:
      return drilled ? add_hole_work(s, c) : add_thread(s, c);
    case part::CutKind::knurl:
      return add_knurl(s, c);
    case part::CutKind::arc:
      return add_arc(s, c);
    case part::CutKind::hole:
      add_hole_work(s, c);
  }
}

}  // namespace

AuxiliaryWork auxiliary_work(const PreparedPart& p, std::size_t setup, Clamping clamping,
                             const SetupWork& work, const Economy& economy) {
  AuxiliaryWork out;
  Site s{p, setup, clamping, work, economy, Stage::roughing, out};
  const auto& d = p.drawing;
  const auto hold = p.setups[setup].hold;
  const bool left = hold == part::End::left;
  const auto* face = free_face(p, setup);
  if (needs_centre(p, setup, clamping) || given_on(s, face))
    add_centre(s, face, left ? d.outer.back().right_mm : d.outer.front().left_mm);
  if (!work.bores.empty()) add_drilling(s, left ? part::End::right : part::End::left);
  for (const std::size_t i : work.bores)
    if (part::is_counterbore(d.inner[i])) add_counterbore(s, i);
  s.stage = Stage::finishing;
  using enum part::CutKind;
  for (const std::size_t i : work.outer_chamfers) add_chamfer(s, i, false);
  for (const std::size_t i : work.inner_chamfers)
    part::is_hole(d.inner[i]) ? add_closing_chamfer(s, i) : add_chamfer(s, i, true);
  for (const auto kind : {arc, groove, hole, thread, knurl}) {
    for (const std::size_t i : work.elements) add_cut(s, d.outer[i], i, false, kind);
    for (const std::size_t i : work.bores) add_cut(s, d.inner[i], i, true, kind);
  }
  add_milled(p, setup, clamping, economy, out);
  if (setup == 0 && d.stock.parted_mm) add_parting(s);
  return out;
}

std::vector<Conflict> conflicts_of(const AuxiliaryWork& work, std::size_t setup) {
  auto all = work.conflicts;
  for (const auto& o : work.all())
    for (const auto& c : o.plan.constraints)
      if (!(c.margin >= -kBeyondRounding))
        all.push_back({c.name, setup_label(setup) + ", " + o.plan.id, c.value, c.limit,
                       c.unit, exceeded(o.plan.id, c)});
  return all;
}

std::vector<Conflict> auxiliary_conflicts(const PreparedPart& p, std::size_t setup,
                                          Clamping clamping, const SetupWork& work) {
  return conflicts_of(auxiliary_work(p, setup, clamping, work, {p.machine_per_min, 1}),
                      setup);
}

}  // namespace turnwright::planning
