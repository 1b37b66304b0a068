#include "fixed_operation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/say.hpp"
#include "chosen_conditions.hpp"
#include "planning/clamping/clamping_speed.hpp"
#include "planning/clamping/positions.hpp"
#include "planning/surface/operation_result.hpp"
#include "planning/values/readable.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::planning::fixed {
namespace {

bool drills(FixedUse use) {
  return use == FixedUse::centring || use == FixedUse::drilling;
}

// The lowest speed and feed of a tool's window.
catalogue::FixedConditions gentlest(const catalogue::FixedConditions& at) {
  if (!at.window) return at;
  return catalogue::at(at, at.window->vc_m_min.lower, at.window->f_mm_rev.lower);
}

// Whether a tool has the size that a given depth names: half a drill's diameter, the width
// of a blade.
bool has_given_depth(const Asked& a, double size) {
  if (!a.given || !a.given->conditions.ap_mm) return false;
  return std::abs(size / ((drills(a.use) ? 2 : 1) * *a.given->conditions.ap_mm) - 1) <
         1e-9;
}

// Only plunges of a groove may be less wide than their blade.
bool may_have_depth(const Asked& a, double size) {
  return !a.given || !a.given->conditions.ap_mm || has_given_depth(a, size) ||
         !(drills(a.use) || a.use == FixedUse::parting);
}

// Adds a limit, or keeps the tighter of two of the same name.
void tighten(std::vector<ConstraintValue>& all, const ConstraintValue& c) {
  const auto it = std::find_if(all.begin(), all.end(),
                               [&](const auto& o) { return o.name == c.name; });
  if (it == all.end())
    all.push_back(c);
  else if (c.margin < it->margin)
    *it = c;
}

}  // namespace

Fitted fitted(const PlanRequest& p, const Asked& a) {
  Fitted best;
  const bool smallest = a.use == FixedUse::parting || a.use == FixedUse::countersinking;
  const auto meant = [&](double size) {
    return a.use == FixedUse::grooving && has_given_depth(a, size);
  };
  const auto is_better = [&](const FixedTool& t, double size) {
    if (!best.tool) return true;
    if (meant(size) != meant(best.size_mm)) return meant(size);
    if (size != best.size_mm) return smallest == (size < best.size_mm);
    return a.use == FixedUse::drilling &&
           std::tie(t.reach, t.id) < std::tie(best.tool->reach, best.tool->id);
  };
  for (const auto& t : p.fixed_tools) {
    const auto* at = t.conditions_in(p.material.group);
    if (t.use != a.use || !at || t.inner != a.inner) continue;
    if (a.given && a.given->tool && *a.given->tool != t.id) continue;
    const auto sizes = t.sizes_mm.empty() ? std::vector{0.0} : t.sizes_mm;
    for (const double size : sizes)
      if (a.fits(t, size) && may_have_depth(a, size) && is_better(t, size))
        best = {&t, size, *at, {}, {}};
  }
  if (!best.tool) return best;
  best.at = catalogue::of_size(best.at, a.use, best.size_mm);
  if (a.given) {
    best.given = a.given->conditions;
    best.window = best.at.window;
    const auto& [vc, f] = std::pair{best.given.vc_m_min, best.given.f_mm_rev};
    if (best.at.window && vc) best.at.window->vc_m_min = {*vc, *vc};
    if (best.at.window && f) best.at.window->f_mm_rev = {*f, *f};
    best.at = catalogue::at(best.at, vc.value_or(best.at.vc_m_min),
                            f.value_or(best.at.f_mm_rev));
  }
  return best;
}

Fitted fitted_if(const PlanRequest& p, const Asked& a,
                 const std::function<bool(const Fitted&)>& borne) {
  if (a.given) return fitted(p, a);
  for (const bool gently : {false, true}) {
    auto asked = a;
    asked.fits = [&](const FixedTool& t, double size) {
      if (!a.fits(t, size)) return false;
      const auto at = catalogue::of_size(*t.conditions_in(p.material.group), a.use, size);
      return borne({&t, size, gently ? gentlest(at) : at, {}, {}});
    };
    if (const auto f = fitted(p, asked); f.tool) return f;
  }
  return fitted(p, a);
}

void refuse(const Site& s, const Asked& a, const std::string& why) {
  const auto task = a.use == FixedUse::parting
                        ? say("part {}", a.surface)  // "part" is the workpiece elsewhere
                        : fmt::format("{} {}", tr(a.does), a.surface);
  s.out.conflicts.push_back({fmt::format("{} {}", a.does, a.surface),
                             setup_label(s.setup), 0, 0, "", task + ": " + why});
}

bool names_tool(const PlanRequest& p, const OperationRequest& o, FixedUse use) {
  return std::ranges::any_of(
      p.fixed_tools, [&](const FixedTool& t) { return o.tool == t.id && t.use == use; });
}

bool is_given_on(const Site& s, const OperationRequest& o, const std::string& surface) {
  return o.kind == OperationKind::fixed && o.setup == s.setup &&
         std::find(o.on.begin(), o.on.end(), surface) != o.on.end();
}

const OperationRequest* given_on(const Site& s, const std::string& surface,
                                 std::optional<FixedUse> use) {
  if (!s.p.operations) return nullptr;
  for (const auto& o : *s.p.operations)
    if (is_given_on(s, o, surface) && (!use || names_tool(s.p, o, *use))) return &o;
  return nullptr;
}

double n_cap_rpm(const Site& s) {
  if (s.driven) return s.ranges.back().n_max_rpm;
  const double force = jaw_force_N(s.p, s.setup, s.clamping, s.stage);
  return std::min({s.ranges.back().n_max_rpm, clamping_rpm(s.p, s.clamping),
                   grip_loss_rpm(s.p, s.clamping, force)});
}

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
    if (M > 0) {  // that of knurling is not known
      tighten(all, constraint(Check::power, units::shaft_power_kW(M, n),
                              cutting::available_kW(ranges, n, false)));
      tighten(all, constraint(Check::torque, M,
                              cutting::available_kW(ranges, n, true) /
                                  units::shaft_power_kW(1, n)));
    }
    tighten(all, constraint(Check::spindle_min, d.n_rpm, ranges.front().n_min_rpm));
    if (tool.Fc_max_N) tighten(all, constraint(Check::force, Fc, *tool.Fc_max_N));
    if (s.driven || s.clamping == Clamping::between_centres) continue;
    const auto grip = grip_forces(s.p, s.setup, s.clamping, s.stage, d);
    tighten(all, constraint(Check::grip, grip.needed_N, grip.closed_N));
  }
  return all;
}

DrillWay drill_way(const FixedTool& drill, double D, double tip, double before) {
  DrillWay way{tip, before + tip};
  auto pecks = cutting::peck_depths_mm(drill.pecking, D, tip);
  pecks.pop_back();
  for (const double depth : pecks) {
    way.fed_mm += kPeck_mm;
    way.rapid_mm += 2 * (depth + before) - kPeck_mm;
  }
  return way;
}

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
                      f.at.window ? tr("the best of the tool's window")
                                  : tr("catalogue conditions, nothing is chosen")};
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

namespace {

// Where the spindle is too slow for the window's lowest speed, its own serves.
std::vector<ConstraintValue> limits_of_given(const Fitted& f, double D_mm, double n_cap) {
  std::vector<ConstraintValue> all;
  const auto& [vc, feed] = std::pair{f.given.vc_m_min, f.given.f_mm_rev};
  if (vc) {
    all.push_back(constraint(Check::spindle_max, units::spindle_rpm(*vc, D_mm), n_cap));
    if (f.window) {
      const double fastest = units::cutting_speed_m_min(n_cap, D_mm);
      const auto [lowest, highest] = f.window->vc_m_min;
      all.push_back(constraint(Check::vc_min, *vc, std::min(lowest, fastest)));
      all.push_back(constraint(Check::vc_max, *vc, highest));
    }
  }
  if (feed && f.window && f.tool->use != FixedUse::threading &&
      f.tool->use != FixedUse::tapping) {
    all.push_back(constraint(Check::feed_min, *feed, f.window->f_mm_rev.lower));
    all.push_back(constraint(Check::feed_max, *feed, f.window->f_mm_rev.upper));
  }
  return all;
}

// At the best conditions of the window, in which given ones leave no choice.
AuxiliaryOperation chosen(const Site& s, Fitted f, const std::vector<double>& D_mm,
                          double n_cap,
                          const std::function<AuxiliaryOperation(const Fitted&)>& make) {
  if (!f.at.window) return make(f);
  auto& [lowest, highest] = f.at.window->vc_m_min;
  highest = std::min(highest, units::cutting_speed_m_min(n_cap, D_mm[0]));
  // By a rounding above the spindle's least speed, which is a limit.
  const double slowest =
      units::cutting_speed_m_min(s.ranges.front().n_min_rpm * (1 + 1e-12), D_mm[0]);
  lowest = std::clamp(slowest, std::min(lowest, highest), highest);
  std::vector<double> breaks;
  for (const auto& range : s.ranges)
    for (const double D : D_mm)
      breaks.push_back(units::cutting_speed_m_min(range.n_max_rpm, D));
  const auto with = [&](const SpeedAndFeed& c) {
    return Fitted{f.tool, f.size_mm, catalogue::at(f.at, c.vc_m_min, c.f_mm_rev), {}, {}};
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

}  // namespace

AuxiliaryOperation at_best(const Site& s, Fitted f, const std::vector<double>& D_mm,
                           double n_cap,
                           const std::function<AuxiliaryOperation(const Fitted&)>& make) {
  auto o = chosen(s, f, D_mm, n_cap, make);
  const auto given = limits_of_given(f, D_mm[0], n_cap);
  o.plan.constraints.insert(o.plan.constraints.end(), given.begin(), given.end());
  return o;
}

bool unfaced(const Site& s, const Asked& a, const CutElement& e, double z) {
  if (!(e.around.front > 0 && z > 0)) return false;
  refuse(s, a,
         say("the end that it begins at is not faced, {:.3g} mm stand before it",
             e.around.front));
  return true;
}

}  // namespace turnwright::planning::fixed
