#include "milled.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "milled_geometry.hpp"
#include "milled_search.hpp"
#include "outcome.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/cutting/fixed.hpp"
#include "turnwright/deflection/rest.hpp"
#include "turnwright/planning/milled_places.hpp"

namespace turnwright::planning {
namespace {

constexpr double kBinding = 1e-4;  // ln: the search stays so far inside a lobe
constexpr std::size_t kDrawn = 240;
constexpr double kSlack = 1e-9;
constexpr double kPassCounts = 200;  // beyond the fewest

double sqr(double x) { return x * x; }

// A place in the setup that is to make it.
struct Site {
  const PartPlan& p;
  const Milled& m;
  std::size_t setup;
  Clamping clamping;
  const Economy& economy;
  double part_mm_N = 0;  // its compliance across the feed
};

// A way with so many passes, and the numbers that its limits share.
struct Choice {
  const MilledWay* way;
  const catalogue::MillingCutter* cutter;
  const catalogue::MillingConditions* grade;
  int passes;
  RunOut out;
  catalogue::Kienzle kc;
  double hm_over_fz, hex_over_fz, ae_mm;
  double ae_sum;  // sum' ae of (2)
  double teeth;   // S of (3)
  double normal;  // Kn/Kt
  double rho;     // of (4)
  double grip_N;  // largest F that the jaws hold; infinite between centres
  double ap_mm(const Milled& m) const { return m.depth_mm / passes; }
};

// Across the feed, of the part as the setup leaves it, at the worst of three places.
double part_mm_N(const PartPlan& p, const Milled& m, std::size_t setup,
                 Clamping clamping) {
  const auto work = assign(p);
  auto done = nothing_finished(p.drawing);
  for (std::size_t s = 0; s <= setup; ++s) finish(done, work.setups[s]);
  const SetupBody body(p, setup, clamping, done);
  const auto shaft = body.shaft();
  const auto supports = planes(p.machine, clamping).tangential;
  const deflection::Beam beam(shaft);
  double most = 0;
  for (const double share : {0.0, 0.5, 1.0}) {
    const double x = body.x_mm(m.z_mm + share * m.length_mm);
    const double at = std::clamp(x, 0.0, body.length_mm());
    if (clamping == Clamping::chuck_steady) {
      const deflection::RestedBeam rested(shaft, shaft, supports,
                                          {body.x_mm(p.setups[setup].steady_z_mm),
                                           p.machine.steady_rest.tangential_mm_N});
      most = std::max(most, rested.at(at).part.f_ww_mm_N);
    } else {
      most = std::max(most, beam.at(at, supports).f_ww_mm_N);
    }
  }
  return most;
}

double tip_mm_N(const std::vector<catalogue::TipMode>& modes) {
  double across = 0, along = 0;
  for (const auto& m : modes) (m.along_feed ? along : across) += 1 / m.stiffness_N_mm;
  return across > 0 ? across : along;
}

double grip_N(const Site& s, double normal) {
  if (s.clamping == Clamping::between_centres) return INFINITY;
  const double force = jaw_force_N(s.p, s.setup, s.clamping, Stage::finishing);
  const cutting::Grip grip{force, s.p.machine.chuck.jaw_mass_radius_kg_m,
                           s.p.machine.chuck.friction,
                           grip_diameter_mm(s.p, s.setup, s.clamping)};
  const double F = std::sqrt(1 + sqr(normal));  // of one newton around the cutter
  return force /
         cutting::grip_needed_N(grip, F, F, s.p.drawing.outer[s.m.element].left_mm);
}

Choice choice(const Site& s, const MilledWay& way, int passes) {
  Choice c;
  c.way = &way;
  c.cutter = &s.m.cutters[way.cutter];
  c.grade = c.cutter->conditions_in(s.p.material.group);
  c.passes = passes;
  c.out = run_out(s.p, s.setup, s.clamping, s.m, c.cutter->dc_mm);
  c.kc = cutting::kienzle_at(s.p.material, c.cutter->gamma_deg);
  const auto all = engagements(s.m, *c.cutter, way.lanes);
  c.hm_over_fz = all[0].chip.hm_over_fz;
  c.hex_over_fz = all[0].chip.hex_over_fz;
  c.ae_mm = all[0].ae_mm;
  c.ae_sum = c.teeth = 0;
  for (const auto& e : all) {
    c.ae_sum = std::max(c.ae_sum, e.ae_mm * std::pow(e.chip.hm_over_fz, -c.kc.m));
    c.teeth =
        std::max(c.teeth, cutting::teeth_sum(e.chip.arc_rad, c.cutter->teeth, c.kc.m));
  }
  const double hm = c.grade->hex_mm.upper * c.hm_over_fz / c.hex_over_fz;
  const auto K = cutting::chip_stiffness(c.kc, s.p.material, hm);
  c.normal = K.Kn_MPa / K.Kt_MPa;
  c.rho = s.part_mm_N / tip_mm_N(tip_modes(s.p, *c.cutter));
  c.grip_N = grip_N(s, c.normal);
  return c;
}

// Eqs. (1) to (4), in one range of the spindle.
MilledCase milled_case(const Site& s, const Choice& c, const cutting::SpeedRange& range) {
  const auto& cutter = *c.cutter;
  const auto& driven = *s.p.machine.driven_tools;
  const double ap = c.ap_mm(s.m), mc = c.kc.m, root = 1 / (1 - mc);
  MilledCase k;
  k.lobes = c.way->lobes.get();
  k.n_min_rpm = std::max(range.n_min_rpm,
                         units::spindle_rpm(c.grade->vc_m_min.lower, cutter.dc_mm));
  k.n_max_rpm = std::min(range.n_max_rpm,
                         units::spindle_rpm(c.grade->vc_m_min.upper, cutter.dc_mm));
  const auto constant = [&](const char* name, double fz) {
    k.caps.push_back({name, fz, 0});
  };
  constant("chip thickness", c.grade->hex_mm.upper / c.hex_over_fz);
  k.caps.push_back({"feed speed", driven.feed_max_mm_min / cutter.teeth, -1});
  for (const auto& line : range.lines) {  // Eq. (2)
    const double full = 60e6 * line.c / (c.kc.k11_MPa * c.ae_sum * ap * cutter.teeth);
    k.caps.push_back(
        {line.torque ? "torque" : "power", std::pow(full, root), (line.s - 1) * root});
  }
  const double per_force = c.kc.k11_MPa * ap * c.teeth;
  constant("cutting force", std::pow(cutter.Fc_max_N / per_force, root));  // Eq. (3)
  if (std::isfinite(c.grip_N))
    constant("grip of the chuck", std::pow(c.grip_N / per_force, root));
  k.fz_min_mm = c.grade->hex_mm.lower / c.hex_over_fz;
  if (s.m.fz_mm) {
    constant("given", *s.m.fz_mm);
    k.fz_min_mm = std::max(k.fz_min_mm, *s.m.fz_mm);
  }
  if (s.m.n_rpm) {
    k.n_min_rpm = std::max(k.n_min_rpm, *s.m.n_rpm);
    k.n_max_rpm = std::min(k.n_max_rpm, *s.m.n_rpm);
  }
  const double layer = layer_mm(s.m, cutter.dc_mm, c.way->lanes, c.out);
  k.path_mm = c.passes * layer;  // Eq. (1)
  if (s.m.kind == MilledKind::keyway) k.path_mm += s.m.depth_mm / kPlungeFeed;
  k.teeth = cutter.teeth;
  k.minute = s.economy.minute;
  k.edge = s.economy.minute * cutter.change_min + s.economy.edge * cutter.edge_cost;
  k.besides = s.economy.minute * c.passes * c.way->lanes *
              (s.m.length_mm + 2 * kApproach_mm) / s.p.machine.rapid_mm_min;
  k.T0_min = c.grade->T0_min;
  k.n0_rpm = units::spindle_rpm(c.grade->v0_m_min, cutter.dc_mm);
  k.nT = c.grade->n;
  k.mc = mc;
  k.load = ap * (1 + s.m.depth_margin) * (1 + c.rho) * c.kc.k11_MPa *
           std::pow(c.hm_over_fz, -mc);  // Eq. (4)
  k.speed_margin = s.m.speed_margin;
  return k;
}

ConstraintValue limit(const std::string& name, const char* unit, double value,
                      double limit_, bool at_most = true) {
  ConstraintValue c{name, unit, value, limit_, at_most, 0, false, 0};
  c.margin = (at_most ? -1 : 1) * std::log(value / limit_);
  c.binding = c.margin < kBinding;
  return c;
}

// What the choice keeps and by how much, evaluated anew at speed and feed.
std::vector<ConstraintValue> limits(const Site& s, const Choice& c, double n, double fz,
                                    double stable_mm) {
  const auto& cutter = *c.cutter;
  const auto& driven = *s.p.machine.driven_tools;
  const auto ranges = cutting::speed_ranges(driven);
  const double ap = c.ap_mm(s.m), mc = c.kc.m;
  const double vc = units::cutting_speed_m_min(n, cutter.dc_mm);
  const double held = std::clamp(n, ranges.front().n_min_rpm, ranges.back().n_max_rpm);
  const double P =
      c.kc.k11_MPa * std::pow(fz, 1 - mc) * c.ae_sum * ap * cutter.teeth * n / 60e6;
  const double M = P / units::shaft_power_kW(1, n);
  const double F = c.kc.k11_MPa * ap * std::pow(fz, 1 - mc) * c.teeth;
  std::vector<ConstraintValue> all{
      limit("stable depth with its margin", "mm", ap * (1 + s.m.depth_margin), stable_mm),
      limit("compliance of the part", "nm/N", 1e6 * s.part_mm_N,
            1e6 * tip_mm_N(tip_modes(s.p, cutter))),
      limit("depth of cut", "mm", ap, cutter.ap_mm.upper),
      limit("least depth of cut", "mm", ap, cutter.ap_mm.lower, false),
      limit("chip thickness", "mm", fz * c.hex_over_fz, c.grade->hex_mm.upper),
      limit("least chip thickness", "mm", fz * c.hex_over_fz, c.grade->hex_mm.lower,
            false),
      limit("cutting speed", "m/min", vc, c.grade->vc_m_min.upper),
      limit("least cutting speed", "m/min", vc, c.grade->vc_m_min.lower, false),
      limit("spindle speed", "1/min", n, ranges.back().n_max_rpm),
      limit("least spindle speed", "1/min", n, ranges.front().n_min_rpm, false),
      limit("feed speed", "mm/min", fz * cutter.teeth * n, driven.feed_max_mm_min),
      limit("power", "kW", P, cutting::available_kW(ranges, held, false)),
      limit("torque", "Nm", M,
            cutting::available_kW(ranges, held, true) / units::shaft_power_kW(1, held)),
      limit("cutting force", "N", F, cutter.Fc_max_N)};
  if (std::isfinite(c.grip_N)) {
    const double force = jaw_force_N(s.p, s.setup, s.clamping, Stage::finishing);
    all.push_back(limit("grip of the chuck", "N", F / c.grip_N * force, force));
  }
  return all;
}

// A choice at a speed and feed, to an operation.
FixedOperation operation(const Site& s, const Choice& c, const MilledCase& k, double n,
                         double fz) {
  const auto& cutter = *c.cutter;
  const double ap = c.ap_mm(s.m), mc = c.kc.m;
  FixedOperation o;
  auto& plan = o.plan;
  plan.kind = OperationKind::mill;
  plan.id = fmt::format("s{}-mill-{}", s.setup, s.m.id);
  plan.on = {s.m.id};
  plan.tool = cutter.id;
  MilledCut cut;
  cut.kind = s.m.kind;
  cut.lanes = c.way->lanes;
  cut.ae_mm = c.ae_mm;
  cut.fz_mm = fz;
  cut.hm_mm = fz * c.hm_over_fz;
  cut.vf_mm_min = fz * cutter.teeth * n;
  cut.Kt_MPa = c.kc.k11_MPa * std::pow(cut.hm_mm, -mc);
  cut.Kn_MPa = c.normal * cut.Kt_MPa;
  cut.depth_margin = s.m.depth_margin;
  cut.speed_margin = s.m.speed_margin;
  cut.part_share = c.rho;
  // Far enough to show what is left beyond the margin asked for.
  cut.shown_mm = std::max(2 * ap * (1 + s.m.depth_margin), 1.5 * cutter.ap_mm.lower);
  const double per_mm = (1 + c.rho) * cut.Kt_MPa;
  cut.limit_mm =
      stable_around_N_mm(*c.way->lobes, n, s.m.speed_margin, cut.shown_mm * per_mm) /
      per_mm;
  Pass pass;
  pass.ap_mm = ap;
  pass.f_mm_rev = fz * cutter.teeth;
  pass.n_rpm = n;
  pass.vc_m_min = units::cutting_speed_m_min(n, cutter.dc_mm);
  pass.time_min = k.path_mm / (fz * cutter.teeth * n) / c.passes;
  pass.Fc_N = c.kc.k11_MPa * ap * std::pow(fz, 1 - mc) * c.teeth;
  pass.Pc_kW =
      c.kc.k11_MPa * std::pow(fz, 1 - mc) * c.ae_sum * ap * cutter.teeth * n / 60e6;
  pass.T_min = life_min(k, n);
  plan.passes.assign(static_cast<std::size_t>(c.passes), pass);
  plan.time_min = c.passes * pass.time_min;
  const double edges = plan.time_min / pass.T_min;
  const double rapid = c.passes * c.way->lanes * (s.m.length_mm + 2 * kApproach_mm) /
                       s.p.machine.rapid_mm_min;
  o.minutes = plan.time_min + rapid + cutter.change_min * edges;
  o.edges_cost = cutter.edge_cost * edges;
  plan.cost = s.p.machine_per_min * o.minutes + o.edges_cost;
  plan.constraints = limits(s, c, n, fz, cut.limit_mm);
  plan.milled = std::move(cut);
  return o;
}

std::pair<int, int> pass_counts(const Milled& m, const catalogue::MillingCutter& c) {
  if (m.passes) return {*m.passes, *m.passes};
  const int fewest =
      std::max(1, static_cast<int>(std::ceil(m.depth_mm / c.ap_mm.upper - kSlack)));
  const double most = std::floor(m.depth_mm / c.ap_mm.lower + kSlack);
  return {fewest, static_cast<int>(std::min(most, fewest + kPassCounts))};
}

void refuse(const Site& s, const std::string& name, double value, double allowed,
            const char* unit, const std::string& why, FixedWork& out) {
  out.conflicts.push_back({name, fmt::format("setup {}, {}", s.setup, s.m.id), value,
                           allowed, unit, fmt::format("{}: {}", s.m.id, why)});
}

// Why none of the choices keeps everything: what stands against the shallowest cut of
// the way that comes nearest, at speeds a margin apart.
void explain(const Site& s, const std::vector<Choice>& choices,
             const std::vector<MilledCase>& cases, FixedWork& out) {
  std::map<const MilledWay*, int> shallowest;
  for (const auto& c : choices) shallowest[c.way] = std::max(shallowest[c.way], c.passes);
  std::size_t nearest = cases.size();
  double most = 0, at = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto& k = cases[i];
    if (choices[i].passes < shallowest[choices[i].way]) continue;
    for (double n = k.n_min_rpm; n <= k.n_max_rpm; n *= 1 + k.speed_margin) {
      const double fz = feed_mm(k, n);
      if (!(fz >= k.fz_min_mm * (1 - kSlack))) continue;
      const double W = load_N_mm(k, fz);
      double stable = W;
      for (const double u : {1 - k.speed_margin, 1.0, 1 + k.speed_margin})
        stable = std::min(stable, k.lobes->stable_to_N_mm(n * u, stable));
      if (stable / W > most) most = stable / W, at = n, nearest = i;
    }
  }
  if (nearest == cases.size()) {
    refuse(s, "feed", 0, 0, "",
           "power, torque, strength, grip and speeds of machine and cutters leave no "
           "feed above the least chip thickness, at any depth of pass",
           out);
    return;
  }
  const auto& c = choices[nearest];
  const double ap = c.ap_mm(s.m), asked = ap * (1 + s.m.depth_margin);
  refuse(
      s, "stable depth with its margin", asked, asked * most, "mm",
      fmt::format("it chatters at every speed: {} passes of {:.4g} mm with {} come "
                  "nearest, at {:.0f} 1/min, where {:.4g} mm are stable but {:.4g} mm "
                  "asked for with the margin; a tool point {:.3g} times as stiff would "
                  "do, or shallower passes",
                  c.passes, ap, c.cutter->id, at, asked * most, asked, 1 / most),
      out);
}

// The best of all ways, pass counts and ranges of the spindle.
void choose(const Site& s, const std::vector<Choice>& choices, FixedWork& out) {
  std::vector<MilledCase> cases;
  std::vector<Choice> of;
  for (const auto& c : choices)
    for (const auto& range : cutting::speed_ranges(*s.p.machine.driven_tools)) {
      const auto k = milled_case(s, c, range);
      if (!(k.n_min_rpm <= k.n_max_rpm)) continue;
      cases.push_back(k);
      of.push_back(c);
    }
  const auto best = cheapest(cases);
  if (!best.found) return explain(s, of, cases, out);
  const auto& k = cases[best.index];
  auto o = operation(s, of[best.index], k, best.n_rpm, feed_mm(k, best.n_rpm));
  o.open = best.cost - best.lower_bound;
  const double counted = s.p.objective == Objective::time ? o.minutes : o.plan.cost;
  const double share = best.cost > 0 ? best.lower_bound / best.cost : 1;
  o.plan.certificate = {
      best.proved ? CertificateKind::global : CertificateKind::local,
      counted * share,
      1 - share,
      best.steps,
      "branch-and-bound",
      best.proved ? "" : "the search of speeds ended before every one was settled"};
  out.after.push_back(std::move(o));
}

// Conditions that are given whole, whatever they keep.
void take(const Site& s, const Choice& c, FixedWork& out) {
  const auto ranges = cutting::speed_ranges(*s.p.machine.driven_tools);
  const auto k = milled_case(s, c, ranges.front());
  auto o = operation(s, c, k, *s.m.n_rpm, *s.m.fz_mm);
  o.plan.certificate = {CertificateKind::global,
                        s.p.objective == Objective::time ? o.minutes : o.plan.cost,
                        0,
                        0,
                        "fixed",
                        "conditions as given"};
  out.after.push_back(std::move(o));
}

void add(const PartPlan& p, const Milled& m, std::size_t setup, Clamping clamping,
         const Economy& economy, FixedWork& out) {
  Site s{p, m, setup, clamping, economy, 0};
  if (const auto why = milled_obstacle(p, assign(p), m, setup, clamping); !why.empty())
    return refuse(s, "setups", 0, 0, "", why, out);
  if (m.ways.empty()) {
    const auto& c = m.cutters.front();
    return refuse(s, "cutter", 0, 0, "",
                  m.cutters.size() == 1
                      ? fmt::format("{} {}", c.id, does_not_fit(p, m, c))
                      : fmt::format("no cutter of the tools fits; {} {}", c.id,
                                    does_not_fit(p, m, c)),
                  out);
  }
  s.part_mm_N = part_mm_N(p, m, setup, clamping);
  const bool whole = m.passes && m.n_rpm && m.fz_mm && m.ways.size() == 1;
  std::vector<Choice> choices;
  std::string why;
  for (const auto& way : m.ways) {
    const auto& cutter = m.cutters[way.cutter];
    const auto [fewest, most] = pass_counts(m, cutter);
    const double ap = m.depth_mm / fewest;
    const auto first = choice(s, way, std::max(fewest, 1));
    const bool closed = !first.out.left && !first.out.right;
    if (m.kind == MilledKind::slot && closed)
      why = fmt::format("{} runs out at neither end in this setup", cutter.id);
    else if (m.kind == MilledKind::flat && closed && cutter.dc_mm > m.length_mm + kSlack)
      why = fmt::format("{} of {:g} mm does not go into {:g} mm between its walls",
                        cutter.id, cutter.dc_mm, m.length_mm);
    else if (first.rho > 1)
      why = fmt::format(
          "the part yields {:.3g} nm/N here, the tool point of {} {:.3g}: "
          "which of them chatters is then not told; clamp it stiffer",
          1e6 * s.part_mm_N, cutter.id, 1e6 * tip_mm_N(tip_modes(p, cutter)));
    else if (!whole &&
             (ap > cutter.ap_mm.upper + kSlack || ap < cutter.ap_mm.lower - kSlack))
      why = fmt::format("{} cuts {:g} to {:g} mm deep, not {:.4g} mm", cutter.id,
                        cutter.ap_mm.lower, cutter.ap_mm.upper, ap);
    else
      for (int passes = fewest; passes <= most; ++passes) {
        choices.push_back(first);
        choices.back().passes = passes;
      }
  }
  if (choices.empty())
    return refuse(s, "cutter", 0, 0, "",
                  why.empty() ? "no number of passes is within the cutters' depths" : why,
                  out);
  if (whole) return take(s, choices.front(), out);
  choose(s, choices, out);
}

}  // namespace

void add_milled(const PartPlan& p, std::size_t setup, Clamping clamping,
                const Economy& economy, FixedWork& out) {
  for (const auto& m : p.milled)
    if (m.setup == setup) add(p, m, setup, clamping, economy, out);
}

void add_lobes(const PartPlan& p, OperationPlan& o) {
  if (!o.milled) return;
  const auto m = std::find_if(p.milled.begin(), p.milled.end(),
                              [&](const Milled& x) { return x.id == o.on.front(); });
  const auto way = std::find_if(m->ways.begin(), m->ways.end(), [&](const MilledWay& w) {
    return m->cutters[w.cutter].id == o.tool && w.lanes == o.milled->lanes;
  });
  auto& cut = *o.milled;
  const auto& cutter = m->cutters[way->cutter];
  const auto* grade = cutter.conditions_in(p.material.group);
  const auto& driven = *p.machine.driven_tools;
  const double n = o.passes.front().n_rpm;
  const double low =
      std::min(n, std::max(driven.n_min_rpm,
                           units::spindle_rpm(grade->vc_m_min.lower, cutter.dc_mm)));
  const double high =
      std::max(n, std::min(driven.n_max_rpm,
                           units::spindle_rpm(grade->vc_m_min.upper, cutter.dc_mm)));
  const double per_mm = (1 + cut.part_share) * cut.Kt_MPa, enough = cut.shown_mm * per_mm;
  for (std::size_t k = 0; k <= kDrawn; ++k) {
    const double speed = low + (high - low) * static_cast<double>(k) / kDrawn;
    const double stable = way->lobes->stable_to_N_mm(speed, enough);
    cut.n_rpm.push_back(speed);
    cut.limits_mm.push_back(stable < enough ? std::optional(stable / per_mm)
                                            : std::nullopt);
  }
}

}  // namespace turnwright::planning
