#include "catalogue_operations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "chosen_conditions.hpp"
#include "milled_operations.hpp"
#include "planning/clamping/centre_clearance.hpp"
#include "planning/clamping/clamping_speed.hpp"
#include "planning/clamping/positions.hpp"
#include "planning/paths/edges.hpp"
#include "planning/surface/operation_result.hpp"
#include "planning/values/readable.hpp"
#include "turnwright/base/dual.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/cutting/fixed.hpp"

namespace turnwright::planning {
namespace {

using catalogue::FixedTool;
using catalogue::FixedUse;
using cutting::Load;

constexpr int kLeastInfeeds = 4;          // of a thread
constexpr double kBeyondRounding = 1e-9;  // a limit counts as over

struct Site {
  const PreparedPart& p;
  std::size_t setup;
  Clamping clamping;
  const SetupWork& work;
  const Economy& economy;
  Stage stage;  // of the jaws' force
  AuxiliaryWork& out;
  std::vector<cutting::SpeedRange> ranges = cutting::speed_ranges(p.machine);
};

// Requirements on a tool.
struct Asked {
  FixedUse use;
  const char* does;  // "groove": of ids and sentences
  std::string surface;
  bool inner = false;
  const OperationRequest* given = nullptr;
  std::function<bool(const FixedTool&, double size)> fits;
};

// A tool in one of its sizes, the conditions in the plan's material.
struct Fitted {
  const FixedTool* tool = nullptr;
  double size_mm = 0;
  catalogue::FixedConditions at = {};
};

bool drills(FixedUse use) {
  return use == FixedUse::centring || use == FixedUse::drilling;
}

// The conditions of a tool in one of its sizes.
catalogue::FixedConditions of_size(catalogue::FixedConditions at, FixedUse use,
                                   double size_mm) {
  if (!catalogue::on_axis(use) || use == FixedUse::tapping) return at;
  at.f_mm_rev *= size_mm;
  if (at.window)
    for (double* f : {&at.window->f_mm_rev.lower, &at.window->f_mm_rev.upper})
      *f *= size_mm;
  return at;
}

// The lowest speed and feed of a tool's window.
catalogue::FixedConditions gentlest(const catalogue::FixedConditions& at) {
  if (!at.window) return at;
  return catalogue::at(at, at.window->vc_m_min.lower, at.window->f_mm_rev.lower);
}

// A given depth names the tool's size: half a drill's diameter, the width of a blade
// that parts off.
bool of_given_depth(const Asked& a, double size) {
  if (!a.given || !a.given->conditions.ap_mm) return true;
  const double ap = *a.given->conditions.ap_mm;
  if (drills(a.use)) return std::abs(size / (2 * ap) - 1) < 1e-9;
  return a.use != FixedUse::parting || std::abs(size / ap - 1) < 1e-9;
}

// The largest size that fits (for parting off and countersinking the smallest), of the
// first tool that has it.
Fitted fitted(const PlanRequest& p, const Asked& a) {
  Fitted best;
  const bool smallest = a.use == FixedUse::parting || a.use == FixedUse::countersinking;
  for (const auto& t : p.fixed_tools) {
    const auto* at = t.conditions_in(p.material.group);
    if (t.use != a.use || !at || t.inner != a.inner) continue;
    if (a.given && a.given->tool && *a.given->tool != t.id) continue;
    const auto sizes = t.sizes_mm.empty() ? std::vector{0.0} : t.sizes_mm;
    for (const double size : sizes)
      if (a.fits(t, size) && of_given_depth(a, size) &&
          (!best.tool || (smallest ? size < best.size_mm : size > best.size_mm)))
        best = {&t, size, *at};
  }
  if (!best.tool) return best;
  best.at = of_size(best.at, a.use, best.size_mm);
  if (a.given) {
    const auto& [vc, f] =
        std::pair{a.given->conditions.vc_m_min, a.given->conditions.f_mm_rev};
    if (best.at.window && vc) best.at.window->vc_m_min = {*vc, *vc};
    if (best.at.window && f) best.at.window->f_mm_rev = {*f, *f};
    best.at = catalogue::at(best.at, vc.value_or(best.at.vc_m_min),
                            f.value_or(best.at.f_mm_rev));
  }
  return best;
}

// The same among those that can be borne at the catalogue's conditions, else at the
// gentlest; if none can, or the operation is given, the one of all, whose limits then tell
// why it cannot be.
Fitted fitted_if(const PlanRequest& p, const Asked& a,
                 const std::function<bool(const Fitted&)>& borne) {
  if (a.given) return fitted(p, a);
  for (const bool gently : {false, true}) {
    auto asked = a;
    asked.fits = [&](const FixedTool& t, double size) {
      if (!a.fits(t, size)) return false;
      const auto at = of_size(*t.conditions_in(p.material.group), a.use, size);
      return borne({&t, size, gently ? gentlest(at) : at});
    };
    if (const auto f = fitted(p, asked); f.tool) return f;
  }
  return fitted(p, a);
}

void refuse(const Site& s, const Asked& a, const std::string& why) {
  s.out.conflicts.push_back({fmt::format("{} {}", a.does, a.surface),
                             setup_label(s.setup), 0, 0, "",
                             fmt::format("{} {}: {}", a.does, a.surface, why)});
}

// Whether the operation names a tool, and one for this.
bool names_tool(const PlanRequest& p, const OperationRequest& o, FixedUse use) {
  return std::ranges::any_of(
      p.fixed_tools, [&](const FixedTool& t) { return o.tool == t.id && t.use == use; });
}

// The given operation at fixed conditions on a surface in this setup; with a tool for a
// use, if that is asked.
const OperationRequest* given_on(const Site& s, const std::string& surface,
                                 std::optional<FixedUse> use = {}) {
  if (!s.p.operations) return nullptr;
  for (const auto& o : *s.p.operations)
    if (o.kind == OperationKind::fixed && o.setup == s.setup &&
        std::find(o.on.begin(), o.on.end(), surface) != o.on.end() &&
        (!use || names_tool(s.p, o, *use)))
      return &o;
  return nullptr;
}

double n_cap_rpm(const Site& s) {
  const double force = jaw_force_N(s.p, s.setup, s.clamping, s.stage);
  return std::min({s.ranges.back().n_max_rpm, clamping_rpm(s.p, s.clamping),
                   grip_loss_rpm(s.p, s.clamping, force)});
}

// Load of a pass on the spindle at one end of its diameters.
struct Duty {
  Load load;
  double n_rpm = 0, D_mm = 0;
  bool radial = false;  // the feed's force does not pull at the jaws
};

// Adds a limit, or keeps the tighter of two of the same name.
void tighten(std::vector<ConstraintValue>& all, const ConstraintValue& c) {
  const auto it = std::find_if(all.begin(), all.end(),
                               [&](const auto& o) { return o.name == c.name; });
  if (it == all.end())
    all.push_back(c);
  else if (c.margin < it->margin)
    *it = c;
}

// Force that the jaws need at rest for a load, and have.
struct GripForces {
  double needed_N = 0, closed_N = 0;
};
GripForces grip_forces(const PreparedPart& p, std::size_t setup, Clamping clamping,
                       Stage stage, const Duty& d) {
  const auto& m = p.machine;
  const double force = jaw_force_N(p, setup, clamping, stage);
  const cutting::Grip grip{force, m.chuck.jaw_mass_radius_kg_m, m.chuck.friction,
                           grip_diameter_mm(p, setup, clamping)};
  const double needed = cutting::grip_needed_N(grip, 2000 * d.load.M_Nm / d.D_mm,
                                               d.radial ? 0.0 : d.load.Ff_N, d.D_mm);
  return {needed + cutting::grip_loss_N(grip, d.n_rpm), force};
}

std::vector<ConstraintValue> limits(const Site& s, const FixedTool& tool,
                                    const std::vector<Duty>& duties) {
  const auto& m = s.p.machine;
  const auto& ranges = s.ranges;
  std::vector<ConstraintValue> all;
  for (const auto& d : duties) {
    const double n =
        std::clamp(d.n_rpm, ranges.front().n_min_rpm, ranges.back().n_max_rpm);
    const auto& [Fc, Ff, M] = d.load;
    if (Ff > 0) tighten(all, constraint(Check::feed_force, Ff, m.feed_force_max_N));
    tighten(all, constraint(Check::power, units::shaft_power_kW(M, n),
                            cutting::available_kW(ranges, n, false)));
    tighten(all, constraint(Check::torque, M,
                            cutting::available_kW(ranges, n, true) /
                                units::shaft_power_kW(1, n)));
    tighten(all, constraint(Check::spindle_min, d.n_rpm, m.n_min_rpm));
    if (tool.Fc_max_N) tighten(all, constraint(Check::force, Fc, *tool.Fc_max_N));
    if (s.clamping == Clamping::between_centres) continue;
    const auto grip = grip_forces(s.p, s.setup, s.clamping, s.stage, d);
    tighten(all, constraint(Check::grip, grip.needed_N, grip.closed_N));
  }
  return all;
}

// Lengths of the passes outside the cut, and where they begin and end (pass_lengths.hpp).
struct Way {
  double fed_min = 0, rapid_mm = 0;
  bool inner = false;
  double from_mm = 0, to_mm = 0;
};

// Adds passes with their forces and paths to an operation: Eq. (6).
AuxiliaryOperation operation(const Site& s, const Asked& a, const Fitted& f,
                             std::vector<Pass> passes, const Way& way,
                             const std::vector<Duty>& duties) {
  AuxiliaryOperation o;
  auto& plan = o.plan;
  plan.kind = OperationKind::fixed;
  plan.id = a.given
                ? (a.given->on.size() > 1 ? a.given->id + ":" + a.surface : a.given->id)
                : fmt::format("s{}-{}-{}", s.setup + 1, a.does, a.surface);
  plan.on = {a.surface};
  plan.tool = f.tool->id;
  for (auto& pass : passes) {
    pass.f_mm_rev = f.at.f_mm_rev;
    pass.T_min = f.at.T_min;
    plan.time_min += pass.time_min;
  }
  plan.edges = plan.time_min / f.at.T_min;
  o.air_min = way.fed_min + way.rapid_mm / s.p.machine.rapid_mm_min;
  o.change_min = f.tool->change_min * plan.edges;
  o.edges_cost = f.tool->edge_cost * plan.edges;
  o.order = {f.size_mm > 0 ? fmt::format("{} {:g}", f.tool->id, f.size_mm) : f.tool->id,
             s.stage,
             drills(a.use),
             way.inner,
             way.from_mm,
             way.to_mm};
  plan.passes = std::move(passes);
  plan.cost = s.p.machine_per_min * o.minutes() + o.edges_cost;
  plan.constraints = limits(s, *f.tool, duties);
  const double counted = s.p.objective == Objective::time ? o.minutes() : plan.cost;
  plan.certificate = {CertificateKind::global,
                      counted,
                      0,
                      0,
                      "fixed",
                      f.at.window ? "the best of the tool's window"
                                  : "catalogue conditions, nothing is chosen"};
  return o;
}

Pass pass_of(const Duty& d, double ap_mm, double time_min) {
  Pass p;
  p.ap_mm = ap_mm;
  p.n_rpm = d.n_rpm;
  p.vc_m_min = units::cutting_speed_m_min(d.n_rpm, d.D_mm);
  p.time_min = time_min;
  p.Fc_N = d.load.Fc_N;
  (d.radial ? p.Fp_N : p.Ff_N) = d.load.Ff_N;
  p.Pc_kW = units::shaft_power_kW(d.load.M_Nm, d.n_rpm);
  return p;
}

// The operation at the best conditions that the tool's window and the request leave open;
// the largest of its diameters comes first.
AuxiliaryOperation at_best(const Site& s, Fitted f, const std::vector<double>& D_mm,
                           double n_cap,
                           const std::function<AuxiliaryOperation(const Fitted&)>& make) {
  if (!f.at.window) return make(f);
  auto& [lowest, highest] = f.at.window->vc_m_min;
  highest = std::min(highest, units::cutting_speed_m_min(n_cap, D_mm[0]));
  // By a rounding above the spindle's least speed, which is a limit.
  const double slowest =
      units::cutting_speed_m_min(s.p.machine.n_min_rpm * (1 + 1e-12), D_mm[0]);
  lowest = std::clamp(slowest, std::min(lowest, highest), highest);
  std::vector<double> breaks;
  for (const auto& range : s.ranges)
    for (const double D : D_mm)
      breaks.push_back(units::cutting_speed_m_min(range.n_max_rpm, D));
  const auto with = [&](const SpeedAndFeed& c) {
    return Fitted{f.tool, f.size_mm, catalogue::at(f.at, c.vc_m_min, c.f_mm_rev)};
  };
  return make(with(best_conditions(*f.at.window, breaks, [&](const SpeedAndFeed& c) {
    const auto o = make(with(c));
    const auto kept = [](const ConstraintValue& each) { return each.margin >= 0; };
    return ConditionsTrial{
        s.economy.minute * (o.plan.time_min + o.air_min),
        s.economy.minute * o.change_min + s.economy.edge * o.edges_cost,
        std::ranges::all_of(o.plan.constraints, kept)};
  })));
}

cutting::Load load_of(const Fitted& f, const PreparedPart& p, double b_mm, double D_mm) {
  return cutting::plunge(cutting::kienzle_at(p.material, f.tool->gamma_deg),
                         catalogue::thrust_of(p.material), b_mm, f.at.f_mm_rev, D_mm);
}

// Eq. (2).
AuxiliaryOperation drilled(const Site& s, const Asked& a, const Fitted& f,
                           double depth_mm) {
  const double D = f.size_mm, n_cap = n_cap_rpm(s);
  const auto kc = cutting::kienzle_at(s.p.material, f.tool->gamma_deg);
  const double front = front_mm(s.p, s.setup, s.work);
  const double path = front + depth_mm + cutting::drill_point_mm(D, f.tool->point_deg);
  double fed = path, rapid = kBefore_mm + path;
  auto pecks = cutting::peck_depths_mm(f.tool->pecking, D, path);
  pecks.pop_back();
  for (const double depth : pecks) {
    fed += kPeck_mm;
    rapid += 2 * (depth + kBefore_mm) - kPeck_mm;
  }
  return at_best(s, f, {D}, n_cap, [&](const Fitted& at) {
    const Duty d{cutting::drill(kc, D, at.at.f_mm_rev, at.tool->point_deg),
                 std::min(units::spindle_rpm(at.at.vc_m_min, D), n_cap), D};
    const double vf = at.at.f_mm_rev * d.n_rpm;
    return operation(s, a, at, {pass_of(d, D / 2, fed / vf)},
                     {kBefore_mm / vf, rapid, true, 0, 0}, {d});
  });
}

// Without any centre drill among the tools the stock is assumed to come centred, where the
// drawing asks for none.
void add_centre(Site& s, const char* face, double end_mm) {
  const auto& drawn = part::centre_at(s.p.drawing, free_end(s.p, s.setup));
  if (!drawn && std::none_of(s.p.fixed_tools.begin(), s.p.fixed_tools.end(),
                             [](const auto& t) { return t.use == FixedUse::centring; }))
    return;
  Asked a{FixedUse::centring,
          "centre",
          face,
          false,
          given_on(s, face),
          [&](const FixedTool& t, double size) {
            return drawn ? t.form == drawn->form && size == drawn->diameter_mm
                         : t.form == 'A' && size <= kCentreShare * end_mm;
          }};
  const auto f = fitted(s.p, a);
  if (f.tool)
    s.out.before.push_back(drilled(s, a, f, f.tool->reach * f.size_mm));
  else
    refuse(s, a,
           drawn ? fmt::format("no centre drill of the tools is for {} and {}",
                               s.p.material.name, part::designation(*drawn))
                 : fmt::format(
                       "no centre drill of the tools is for {} and an end of {:g} mm",
                       s.p.material.name, end_mm));
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

// Whether a setup drills a centre hole without being told to.
bool needs_centre(const PreparedPart& p, std::size_t setup, Clamping clamping) {
  const auto end = free_end(p, setup);
  if (part::centre_at(p.drawing, end)) return makes_centre(p, setup, end);
  return has_live_centre(clamping) && !(free_bore_mm(p, setup) > 0);
}

// The bores of a bar that open to an end: how deep, and the narrowest diameter.
struct Hole {
  double depth_mm = 0, least_mm = INFINITY;
  std::string first;      // the outermost bore
  double drilled_mm = 0;  // of the innermost if it is a hole: the drill's diameter
  /// Material left between it and the bores of the other end, or that end; the narrowest
  /// of those bores.
  double rest_mm = 0, behind_mm = INFINITY;

  // Whether a drill's point stays clear of the drawn surfaces behind; between bores from
  // both ends each may use half.
  bool spares_behind(const FixedTool& drill, double size_mm) const {
    if (rest_mm < kNoWall_mm) return size_mm <= behind_mm;
    const double point = cutting::drill_point_mm(size_mm, drill.point_deg);
    return point < (std::isfinite(behind_mm) ? rest_mm / 2 : rest_mm);
  }
};
Hole hole_from(const part::Drawing& d, part::End end) {
  Hole h;
  if (d.stock.kind != part::StockKind::bar) return h;
  h.rest_mm = part::length_mm(d);
  double needed = 0;  // by reamers and taps
  for (const auto& e : d.inner) {
    h.rest_mm -= e.length_mm;
    if (e.from != end) {
      h.behind_mm = std::min({h.behind_mm, e.left_mm, e.right_mm});
      continue;
    }
    if (h.first.empty()) h.first = e.id;
    h.depth_mm += e.length_mm;
    h.least_mm = std::min({h.least_mm, e.left_mm, e.right_mm});
    h.drilled_mm = part::is_hole(e) ? e.cut->drilled_mm : 0;
    if (part::is_hole(e)) needed = std::max(needed, h.depth_mm + e.cut->lead_mm);
  }
  if (!(needed > h.depth_mm)) return h;
  if (h.rest_mm >= kNoWall_mm) h.rest_mm -= needed - h.depth_mm;
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
          "drill",
          h.first,
          false,
          given,
          [h](const FixedTool& t, double size) {
            return (h.drilled_mm > 0 ? size == h.drilled_mm
                                     : size <= h.least_mm - 2 * kLeftToBore_mm) &&
                   h.depth_mm <= t.reach * size && h.spares_behind(t, size);
          }};
}

const OperationRequest* given_drilling(const PlanRequest& p, part::End end) {
  if (!p.operations) return nullptr;
  for (const auto& o : *p.operations)
    for (const auto& e : p.drawing.inner)
      if (o.kind == OperationKind::fixed && e.from == end &&
          (!e.cut || part::is_hole(e)) && p.setups[o.setup].hold != end &&
          (!o.tool || names_tool(p, o, FixedUse::drilling)) &&
          std::find(o.on.begin(), o.on.end(), e.id) != o.on.end())
        return &o;
  return nullptr;
}

Fitted fitted_drill(const PreparedPart& p, std::size_t setup, const Asked& a) {
  return fitted_if(p, a, [&](const Fitted& f) { return drives(p, setup, f); });
}

void add_drilling(Site& s, part::End end) {
  const auto h = hole_from(s.p.drawing, end);
  if (h.first.empty()) return;
  const auto a = drilling(h, given_drilling(s.p, end));
  const auto f = fitted_drill(s.p, s.setup, a);
  if (f.tool)
    s.out.before.push_back(
        drilled(s, a, f, drilled_depth_mm(s.p, s.setup, end, f.tool->reach * f.size_mm)));
  else
    refuse(
        s, a,
        fmt::format(
            "none of the drills is for {}, {}{:g} mm in diameter and long enough for "
            "{:g} mm{}",
            s.p.material.name, h.drilled_mm > 0 ? "" : "at most ",
            h.drilled_mm > 0 ? h.drilled_mm : h.least_mm - 2 * kLeftToBore_mm, h.depth_mm,
            h.rest_mm < kNoWall_mm && !std::isfinite(h.behind_mm)
                ? ""
                : ", with a point that stays clear of what lies behind the hole"));
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

// An element with a groove, thread or arc: its place and its requirements.
struct CutElement {
  const std::string& id;
  const part::Cut& cut;
  bool inner;
  std::size_t index;
  double length_mm, small_mm, large_mm;  // blank and drawn diameters together
  double bored_mm;                       // of the blank, what an inner tool enters
  Surroundings around;
  double root_h() const { return around.h0 - cut.depth_mm; }
};

// Rapid travel [mm] from outside the stock, or from the mouth of a bore, to an element and
// back.
double down_and_back_mm(const CutElement& e) {
  const auto& s = e.around;
  if (e.inner) return 2 * (s.front + kClear_mm - s.z1);
  return 2 * (s.stock_h + kClear_mm - std::max(s.h0, s.h1) - kAbove_mm);
}
double above_mm(const CutElement& e) { return e.inner ? kAboveBore_mm : kAbove_mm; }

Asked asked(const Site& s, const CutElement& e, FixedUse use, const char* does,
            std::function<bool(const FixedTool&, double)> fits) {
  return {use,
          does,
          e.id,
          e.inner,
          given_on(s, e.id),
          [&e, fits](const FixedTool& t, double size) {
            return (!e.inner || t.min_bore_mm <= e.bored_mm) && fits(t, size);
          }};
}

// Whether material before the free end is in the way of an operation that begins at a
// position.
bool unfaced(const Site& s, const Asked& a, const CutElement& e, double z) {
  if (!(e.around.front > 0 && z > 0)) return false;
  refuse(s, a,
         fmt::format("the end that it begins at is not faced, {:.3g} mm stand before it",
                     e.around.front));
  return true;
}

int times(double whole, double part) {
  return std::max(1, static_cast<int>(std::ceil(whole / part - 1e-9)));
}

// The given number of passes, or the one that follows from a given depth; nothing if the
// two contradict.
std::optional<int> passes_of(const Site& s, const Asked& a, int otherwise,
                             const std::function<int(double)>& at_depth) {
  if (!a.given) return otherwise;
  const auto& c = a.given->conditions;
  if (!c.ap_mm) return c.passes.value_or(otherwise);
  const int least = at_depth(*c.ap_mm);
  const int n = c.passes.value_or(least);
  if (n >= least) return n;
  refuse(s, a, fmt::format("{} passes of {:g} mm are too few", n, *c.ap_mm));
  return std::nullopt;
}

// Whether machine, jaws and tool bear a blade at the ends of its plunge.
bool bears(const Site& s, const Fitted& f, const CutElement& e) {
  return std::ranges::all_of(
      limits(s, *f.tool, plunging(s, f, e.small_mm, e.large_mm)),
      [](const ConstraintValue& c) { return c.margin >= -kBeyondRounding; });
}

void add_groove(Site& s, const CutElement& e) {
  auto a =
      asked(s, e, FixedUse::grooving, "groove", [&](const FixedTool& t, double size) {
        return size <= e.length_mm * (1 + 1e-9) && e.cut.depth_mm <= t.reach;
      });
  const auto f = fitted_if(s.p, a, [&](const Fitted& each) { return bears(s, each, e); });
  if (!f.tool)
    return refuse(s, a,
                  fmt::format("no blade of the tools is for {}, at most {:g} mm wide and "
                              "reaches {:g} mm deep",
                              s.p.material.name, e.length_mm, e.cut.depth_mm));
  const auto plunges = passes_of(s, a, times(e.length_mm, f.size_mm), [&](double ap) {
    return times(e.length_mm, std::min(ap, f.size_mm));
  });
  if (plunges && *plunges * f.size_mm < e.length_mm * (1 - 1e-9))
    return refuse(s, a,
                  fmt::format("{} plunges of a blade of {:g} mm are less than its width, "
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
constexpr const char* kNotTapped =
    " in a bore of {:g} mm, and no tap that goes as deep with its lead, and has its "
    "drill, makes it: a tapped thread is the innermost bore of its end or has a hole of "
    "its drill's diameter behind it, and no edge but a chamfer that a countersink cuts";

// Eq. (4).
void add_thread(Site& s, const CutElement& e) {
  const double P = e.cut.pitch_mm;
  auto a = asked(s, e, FixedUse::threading, "thread", [&](const FixedTool& t, double) {
    return t.pitch_mm.lower <= P && P <= t.pitch_mm.upper;
  });
  auto f = fitted(s.p, a);
  if (!f.tool)
    return refuse(s, a,
                  fmt::format("no threading tool of the tools is for {} and a pitch of "
                              "{:g} mm{}",
                              s.p.material.name, P,
                              e.inner ? fmt::format(kNotTapped, e.bored_mm) : ""));
  if (a.given && std::abs(a.given->conditions.f_mm_rev.value_or(P) / P - 1) > 1e-9)
    return refuse(s, a, fmt::format("its feed is its pitch, {:g} mm", P));
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
    return refuse(
        s, a,
        fmt::format("its run-in would cut {:.3g} mm of what rises to it in front, "
                    "more than three pitches",
                    room.rising_mm));
  if (!way_in)
    return refuse(
        s, a,
        fmt::format("its tool has {:.3g} mm to come in behind what is higher than "
                    "the thread's root, and needs {:.3g} mm",
                    room.before_mm, least_run_in_mm(room, P) + P / 2));
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

// A reamer or a tap goes through its hole to its lead beyond, and back at the same feed:
// in the cut both ways.
AuxiliaryOperation through_hole(const Site& s, const Asked& a, const Fitted& f,
                                const CutElement& e, double n_cap,
                                const std::function<Load(const Fitted&)>& load) {
  const double z0 = e.around.z0, front = e.around.front;
  const double start = hole_start_mm(z0, front), before = start + kBefore_mm - z0;
  return at_best(s, f, {f.size_mm}, n_cap, [&](const Fitted& at) {
    const Duty d{load(at),
                 std::min(units::spindle_rpm(at.at.vc_m_min, at.size_mm), n_cap),
                 at.size_mm};
    const double vf = at.at.f_mm_rev * d.n_rpm;
    return operation(s, a, at, {pass_of(d, e.cut.depth_mm, 2 * e.length_mm / vf)},
                     {2 * (before + e.cut.lead_mm) / vf, 2 * (front - start), true, 0, 0},
                     {d});
  });
}

// The chamfer where a hole begins: Eq. (8).
void add_countersinking(Site& s, const CutElement& e) {
  const auto& c = e.around.front_chamfer;
  if (!(c.axial_mm > 0)) return;
  const double D = 2 * (c.radial_mm - e.around.h0), drilled = e.cut.drilled_mm;
  const double room = part::way_in_mm(s.p.drawing, e.index) - 2 * kAboveBore_mm;
  const Asked a{FixedUse::countersinking,
                "countersink",
                e.id,
                false,
                given_on(s, e.id, FixedUse::countersinking),
                [&](const FixedTool& t, double size) {
                  return size >= D && size <= room &&
                         part::fits_countersink(c, t.point_deg);
                }};
  const auto f = fitted(s.p, a);
  if (!f.tool)
    return refuse(s, a,
                  fmt::format("no countersink of the tools is for {}, of the chamfer's "
                              "angle, at least {:g} mm in diameter and passes the bores "
                              "before it",
                              s.p.material.name, D));
  if (unfaced(s, a, e, e.around.z0 + kBefore_mm)) return;
  const auto kc = cutting::kienzle_at(s.p.material, f.tool->gamma_deg);
  const double in = cutting::drill_point_mm(D, f.tool->point_deg), fed = kBefore_mm + in;
  const double cut = in - cutting::drill_point_mm(drilled, f.tool->point_deg);
  const double n_cap = n_cap_rpm(s), inside = e.around.front - e.around.z0;
  s.out.after.push_back(at_best(s, f, {D}, n_cap, [&](const Fitted& at) {
    const Duty duty{cutting::ream(kc, D, drilled, at.at.f_mm_rev, at.tool->edges,
                                  at.tool->point_deg / 2),
                    std::min(units::spindle_rpm(at.at.vc_m_min, D), n_cap), D};
    const double vf = at.at.f_mm_rev * duty.n_rpm;
    return operation(s, a, at, {pass_of(duty, (D - drilled) / 2, cut / vf)},
                     {(fed - cut) / vf, 2 * inside + fed, true, 0, 0}, {duty});
  }));
}

// Eq. (7).
void add_reaming(Site& s, const CutElement& e) {
  const double D = e.cut.drawn.left_mm, deep = e.length_mm + e.cut.lead_mm;
  const Asked a{FixedUse::reaming,
                "ream",
                e.id,
                false,
                given_on(s, e.id, FixedUse::reaming),
                [&](const FixedTool& t, double size) {
                  return size == D && deep <= t.reach * D && t.lead <= e.cut.lead_mm;
                }};
  const auto f = fitted(s.p, a);
  if (!f.tool)
    return refuse(s, a,
                  fmt::format("no reamer of the tools is for {}, {:g} mm in diameter and "
                              "reaches {:g} mm deep",
                              s.p.material.name, D, deep));
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
                "tap",
                e.id,
                false,
                given_on(s, e.id, FixedUse::tapping),
                [&](const FixedTool& t, double) {
                  return catalogue::thread_of(t, d, P) && deep <= t.reach * d &&
                         t.lead * P <= e.cut.lead_mm * (1 + kBeyondRounding);
                }};
  auto f = fitted(s.p, a);
  if (!f.tool)
    return refuse(
        s, a,
        fmt::format("no tap of the tools is for {} and a thread of {:g} mm with "
                    "a pitch of {:g} mm, {:g} mm deep",
                    s.p.material.name, d, P, deep));
  f.size_mm = d;
  f.at.f_mm_rev = P;
  if (f.at.window) f.at.window->f_mm_rev = {P, P};
  const auto kc = cutting::kienzle_at(s.p.material, f.tool->gamma_deg);
  const double n_cap = std::min(n_cap_rpm(s), s.p.machine.rapid_mm_min / P);
  s.out.after.push_back(through_hole(s, a, f, e, n_cap, [&](const Fitted& at) {
    return cutting::tap(kc, d, P, e.cut.depth_mm, at.tool->lead, at.tool->edges);
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
  refuse(s, a,
         fmt::format("it ends {:.3g} mm before the jaws, its tool's corner needs {:.3g} "
                     "mm: grip less",
                     left, needed));
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
  auto a = asked(s, e, FixedUse::profiling, "arc", [&](const FixedTool& t, double) {
    return e.cut.convex || t.re_mm <= e.cut.radius_mm;
  });
  const auto f = fitted(s.p, a);
  if (!f.tool)
    return refuse(
        s, a, fmt::format("no profiling tool of the tools is for {}", s.p.material.name));
  const auto count = passes_of(s, a, times(e.cut.depth_mm, f.tool->ap_mm),
                               [&](double ap) { return times(e.cut.depth_mm, ap); });
  if (!count) return;
  const double D = e.large_mm, ap = e.cut.depth_mm / *count;
  if (ap > f.tool->ap_mm * (1 + 1e-9))
    return refuse(s, a,
                  fmt::format("{} passes of {:.4g} mm are deeper than the {:g} mm of {}",
                              *count, ap, f.tool->ap_mm, f.tool->id));
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

// A chamfer at the free end by a pass of its own, along its line in cuts as deep as the
// tool may; depth and forces are those across the line.
void add_chamfer(Site& s, std::size_t index, bool inner) {
  const auto& d = s.p.drawing;
  const auto& id = inner ? d.inner[index].id : d.outer[index].id;
  const Element element{inner, index};
  const auto c = *front_chamfer(s.p, s.setup, element);
  const auto around = surroundings(s.p, s.setup, s.clamping, s.work, element);
  const double bore = -2 * around.h0, D = inner ? bore + 2 * c.radial_mm : 2 * around.h0;
  const Asked a{
      FixedUse::profiling,
      "chamfer",
      id,
      inner,
      given_on(s, id),
      [&](const FixedTool& t, double) { return !inner || t.min_bore_mm <= bore; }};
  const auto f = fitted(s.p, a);
  if (!f.tool)
    return refuse(
        s, a,
        fmt::format("no profiling tool of the tools is for {}{}", s.p.material.name,
                    inner ? fmt::format(" in a bore of {:g} mm", bore) : std::string()));
  const double length = std::hypot(c.axial_mm, c.radial_mm);
  const double depth = c.axial_mm * c.radial_mm / length;
  const auto passes = passes_of(s, a, times(depth, f.tool->ap_mm),
                                [&](double ap) { return times(depth, ap); });
  if (!passes) return;
  const int count = *passes;
  const double outside = inner ? around.front + kClear_mm : around.stock_h - around.h0;
  const double from = inner ? bore / 2 : around.z0 + kBefore_mm;
  s.out.after.push_back(profiled(
      s, a, f, {count, depth / count, D, length},
      {count * (kBefore_mm + f.tool->re_mm + kBehind_mm),
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
    return refuse(s, a, "a part between centres is not parted off");
  const auto f = fitted(s.p, a);
  if (!f.tool)
    return refuse(s, a,
                  fmt::format("no blade of the tools is for {}, reaches {:g} mm deep and "
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
  if (s.p.operations && !drilled && !given_on(s, e.id)) {
    s.out.conflicts.push_back(
        {"operations", setup_label(s.setup), 0, 0, "",
         fmt::format(
             "{} has no operation of kind \"fixed\": only its blank would be made",
             e.id)});
    return;
  }
  const auto [low, high] =
      std::minmax({e.left_mm, e.right_mm, e.cut->drawn.left_mm, e.cut->drawn.right_mm});
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
      if (!drilled) return add_thread(s, c);
      add_countersinking(s, c);
      return add_tapping(s, c);
    case part::CutKind::arc:
      return add_arc(s, c);
    case part::CutKind::hole:
      add_countersinking(s, c);
      if (c.cut.depth_mm > 0) add_reaming(s, c);
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
  s.stage = Stage::finishing;
  using enum part::CutKind;
  for (const std::size_t i : work.outer_chamfers) add_chamfer(s, i, false);
  for (const std::size_t i : work.inner_chamfers) add_chamfer(s, i, true);
  for (const auto kind : {arc, groove, hole, thread}) {
    for (const std::size_t i : work.elements) add_cut(s, d.outer[i], i, false, kind);
    for (const std::size_t i : work.bores) add_cut(s, d.inner[i], i, true, kind);
  }
  add_milled(p, setup, clamping, economy, out);
  if (setup == 0 && d.stock.parted_mm) add_parting(s);
  return out;
}

double hole_start_mm(double begins_mm, double front_mm) {
  return begins_mm > -kNoWall_mm ? std::max(begins_mm, front_mm) : begins_mm;
}

double drilled_depth_mm(const PreparedPart& p, std::size_t setup, part::End end,
                        double longest_mm) {
  const auto h = hole_from(p.drawing, end);
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
  const auto h = hole_from(p.drawing, end);
  if (h.first.empty()) return 0;
  const auto a = drilling(h, given_drilling(p, end));
  const auto setup = setup_of(p, h.first);
  return (setup ? fitted_drill(p, *setup, a) : fitted(p, a)).size_mm;
}

std::vector<Conflict> auxiliary_conflicts(const PreparedPart& p, std::size_t setup,
                                          Clamping clamping, const SetupWork& work) {
  const auto fixed = auxiliary_work(p, setup, clamping, work, {p.machine_per_min, 1});
  auto all = fixed.conflicts;
  for (const auto& o : fixed.all())
    for (const auto& c : o.plan.constraints)
      if (!(c.margin >= -kBeyondRounding))
        all.push_back({c.name, setup_label(setup) + ", " + o.plan.id, c.value, c.limit,
                       c.unit, exceeded(o.plan.id, c)});
  return all;
}

}  // namespace turnwright::planning
