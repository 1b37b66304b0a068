#include "milled_operations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/say.hpp"
#include "cross_holes.hpp"
#include "milled_choice.hpp"
#include "milled_ways.hpp"
#include "planning/values/most_passes.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::planning {
namespace {

constexpr std::size_t kDrawn = 160;
constexpr int kPassCounts = 200;  // beyond the fewest
constexpr double kRounding = 1e-9;

std::pair<int, int> pass_counts(const Milled& m, const catalogue::MillingCutter& c) {
  if (m.passes) return {*m.passes, *m.passes};
  const int fewest =
      std::max(1, counted_passes(std::ceil(m.depth_mm / c.ap_mm.upper - kSlack_mm)));
  const int most = counted_passes(std::floor(m.depth_mm / c.ap_mm.lower + kSlack_mm));
  return {fewest, std::max(fewest, std::min({most, kMostPasses, fewest + kPassCounts}))};
}

void refuse_milling(const MilledSite& s, const std::string& name, double value,
                    double allowed, const char* unit, const std::string& why,
                    AuxiliaryWork& out) {
  out.conflicts.push_back({name, setup_label(s.setup) + ", " + s.m.id, value, allowed,
                           unit, fmt::format("{}: {}", s.m.id, why)});
}

// The first reason; the others are similar.
std::string listed(const std::vector<std::string>& reasons) {
  return reasons.size() == 1
             ? reasons[0]
             : say("no cutter does: {}; {} more", reasons[0], reasons.size() - 1);
}

void add_once(std::vector<std::string>& all, std::string one) {
  if (std::find(all.begin(), all.end(), one) == all.end()) all.push_back(std::move(one));
}

// Smallest and largest values of the choices.
template <class F>
catalogue::Range span(const std::vector<MilledChoice>& choices, F range_of) {
  catalogue::Range all{INFINITY, 0};
  for (const auto& c : choices) {
    const catalogue::Range r = range_of(c);
    all = {std::min(all.lower, r.lower), std::max(all.upper, r.upper)};
  }
  return all;
}

// A given speed or feed that no choice has, or cutters and spindle without a common
// speed.
bool refused_outright(const MilledSite& s, const std::vector<MilledChoice>& choices,
                      AuxiliaryWork& out) {
  const auto& driven = *s.p.machine.driven_tools;
  const bool meet = std::ranges::any_of(choices, [&](const MilledChoice& c) {
    const auto n = speeds_rpm(s.p, *c.cutter);
    return n.lower <= n.upper;
  });
  if (!meet) {
    const auto own = span(choices, [](const MilledChoice& c) {
      return catalogue::Range{
          units::spindle_rpm(c.grade->vc_m_min.lower, c.cutter->dc_mm),
          units::spindle_rpm(c.grade->vc_m_min.upper, c.cutter->dc_mm)};
    });
    const bool slow = driven.n_max_rpm < own.lower;
    refuse_milling(s, to_translate("spindle speed"), slow ? own.lower : own.upper,
                   slow ? driven.n_max_rpm : driven.n_min_rpm, "1/min",
                   say("cutters turn at {:.4g} to {:.4g} 1/min, the driven spindle at "
                       "{:.4g} to {:.4g} 1/min: no speed is in common",
                       own.lower, own.upper, driven.n_min_rpm, driven.n_max_rpm),
                   out);
    return true;
  }
  const auto outside = [&](const char* name, const std::optional<double>& given,
                           const catalogue::Range& r, const char* unit) {
    if (!given ||
        (*given >= r.lower * (1 - kRounding) && *given <= r.upper * (1 + kRounding)))
      return false;
    refuse_milling(s, name, *given, std::clamp(*given, r.lower, r.upper), unit,
                   say("{:g} {} is given, {:.4g} to {:.4g} {} is what cutter and spindle "
                       "have",
                       *given, unit, r.lower, r.upper, unit),
                   out);
    return true;
  };
  const auto n =
      span(choices, [&](const MilledChoice& c) { return speeds_rpm(s.p, *c.cutter); });
  const auto fz = span(choices, [](const MilledChoice& c) {
    return catalogue::Range{c.grade->hex_mm.lower / c.hex_over_fz,
                            c.grade->hex_mm.upper / c.hex_over_fz};
  });
  return outside(to_translate("spindle speed"), s.m.n_rpm, n, "1/min") ||
         outside(to_translate("feed per tooth"), s.m.fz_mm, fz, "mm");
}

// Explains infeasibility by the way with the largest stable-to-required depth ratio, at
// the shallowest cut that was tried, on a grid of speeds one margin apart.
void explain(const MilledSite& s, const std::vector<MilledChoice>& choices,
             const std::vector<MilledCase>& cases, AuxiliaryWork& out) {
  std::map<const MilledWay*, int> shallowest;
  for (const auto& c : choices) shallowest[c.way] = std::max(shallowest[c.way], c.passes);
  std::size_t nearest = cases.size();
  double most = -1, at = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto& k = cases[i];
    if (choices[i].passes < shallowest[choices[i].way]) continue;
    for (double n = k.n_min_rpm; n <= k.n_max_rpm; n *= 1 + k.speed_margin) {
      const double fz = feed_mm(k, n);
      if (!(fz >= k.fz_min_mm * (1 - kRounding))) continue;
      const double W = load_N_mm(k, fz);
      double stable = W;
      for (const double u : {1 - k.speed_margin, 1.0, 1 + k.speed_margin})
        stable = std::min(stable, stable_to_N_mm(k, n * u, stable));
      if (stable / W > most) most = stable / W, at = n, nearest = i;
    }
  }
  if (nearest == cases.size()) {
    refuse_milling(
        s, to_translate("feed"), 0, 0, "",
        say("power, torque, strength, grip and speeds of machine and cutters "
            "leave no feed above {}, {}",
            s.m.fz_mm ? tr("that given") : tr("the least chip thickness"),
            s.m.passes ? tr("at the depth given") : tr("at any depth of pass")),
        out);
    return;
  }
  const auto& c = choices[nearest];
  const auto& k = cases[nearest];
  const double ap = c.ap_mm(s.m), asked = ap * (1 + s.m.depth_margin);
  const double W = load_N_mm(k, feed_mm(k, at));
  most = stable_around_N_mm(k, at, W) / W;
  const std::string help =
      most > 0 ? say("a tool point {:.3g} times as stiff would do", 1 / most)
               : tr("the limits of stability cannot be told there");
  refuse_milling(
      s, to_translate("stable depth with its margin"), asked, asked * most, "mm",
      say("it chatters at {}: {}, at {:.0f} 1/min, where {:.4g} mm are stable but "
          "{:.4g} mm asked for with the margin; {}{}",
          s.m.n_rpm ? tr("the speed given") : tr("every speed"),
          c.passes == 1
              ? say("1 pass of {:.4g} mm with {} comes nearest", ap, c.cutter->id)
              : say("{} passes of {:.4g} mm with {} come nearest", c.passes, ap,
                    c.cutter->id),
          at, asked * most, asked, help, s.m.passes ? tr(", or more passes") : ""),
      out);
}

// The best of all ways, pass counts and ranges of the spindle.
void choose(const MilledSite& s, const std::vector<MilledChoice>& choices,
            AuxiliaryWork& out) {
  std::vector<MilledCase> cases;
  std::vector<MilledChoice> of;
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
  auto o = milled_operation(s, of[best.index], k, best.n_rpm, feed_mm(k, best.n_rpm));
  o.open = best.cost - best.lower_bound;
  const double counted = s.p.objective == Objective::time ? o.minutes() : o.plan.cost;
  const double share = best.cost > 0 ? best.lower_bound / best.cost : 1;
  o.plan.certificate = {
      best.proved ? CertificateKind::global : CertificateKind::local,
      counted * share,
      1 - share,
      best.steps,
      "branch-and-bound",
      best.proved ? "" : tr("the search of speeds ended before every one was settled")};
  o.order = milled_order(s.p, s.m, s.setup, o.plan.tool);
  out.after.push_back(std::move(o));
}

// Completely given conditions; the limits need not be kept.
void take(const MilledSite& s, const MilledChoice& c, AuxiliaryWork& out) {
  const auto ranges = cutting::speed_ranges(*s.p.machine.driven_tools);
  const auto k = milled_case(s, c, ranges.front());
  auto o = milled_operation(s, c, k, *s.m.n_rpm, *s.m.fz_mm);
  o.plan.certificate = {CertificateKind::global,
                        s.p.objective == Objective::time ? o.minutes() : o.plan.cost,
                        0,
                        0,
                        "fixed",
                        tr("conditions as given")};
  o.order = milled_order(s.p, s.m, s.setup, o.plan.tool);
  out.after.push_back(std::move(o));
}

// The reason why a cutter that fits cannot be used here; empty if it can.
std::string stopped(const MilledSite& s, const MilledChoice& c, bool whole) {
  const auto& cutter = *c.cutter;
  if (c.passes > kMostPasses)
    return say("{} would take more than {} passes", cutter.id, kMostPasses);
  const double D = cutter.dc_mm, ap = c.ap_mm(s.m);
  const bool closed = !c.out.left && !c.out.right;
  const double beside = depth_beside_mm(s.p, s.setup, s.m, D, c.out);
  if (s.m.kind == MilledKind::slot && closed)
    return say("{} runs out at neither end in this setup", cutter.id);
  if (s.m.kind == MilledKind::flat && closed && D > s.m.length_mm + kSlack_mm)
    return say("{} of {:g} mm does not go into {:g} mm between its walls", cutter.id, D,
               s.m.length_mm);
  if (cutter.lu_mm < beside - kSlack_mm)
    return say(
        "{} reaches {:g} mm, its holder would meet what stands {:.4g} mm "
        "above the floor within {:g} mm",
        cutter.id, cutter.lu_mm, beside, kHolder_mm);
  if (c.rho > 1)
    return say(
        "the part yields {:.3g} nm/N here, the tool point of {} {:.3g}: "
        "which of them chatters is then not told; clamp it stiffer",
        1e6 * s.part_mm_N, cutter.id, 1e6 * tip_mm_N(tip_modes(s.p, cutter)));
  if (!whole &&
      (ap > cutter.ap_mm.upper + kSlack_mm || ap < cutter.ap_mm.lower - kSlack_mm))
    return say("{} cuts {:g} to {:g} mm deep, not {:.4g} mm", cutter.id,
               cutter.ap_mm.lower, cutter.ap_mm.upper, ap);
  return {};
}

void add(const PreparedPart& p, const MilledPlace& m, std::size_t setup,
         Clamping clamping, const Economy& economy, AuxiliaryWork& out) {
  MilledSite s{p, m, setup, clamping, economy, 0};
  if (const auto why = milled_obstacle(p, m, setup, clamping); !why.empty())
    return refuse_milling(s, to_translate("setups"), 0, 0, "", why, out);
  if (m.kind == MilledKind::cross_hole)
    return add_cross_hole(p, m, setup, clamping, economy, out);
  s.part_mm_N = part_mm_N(p, m, setup, clamping);
  const bool whole = m.passes && m.n_rpm && m.fz_mm && m.ways.size() == 1;
  std::vector<MilledChoice> choices;
  std::vector<std::string> reasons;
  if (m.ways.empty())
    for (const auto& c : m.cutters) reasons.push_back(c.id + " " + does_not_fit(p, m, c));
  for (const auto& way : m.ways) {
    const auto [fewest, most] = pass_counts(m, m.cutters[way.cutter]);
    const auto first = milled_choice(s, way, fewest);
    if (auto why = stopped(s, first, whole); !why.empty()) {
      add_once(reasons, std::move(why));
      continue;
    }
    for (int passes = fewest; passes <= most; ++passes) {
      choices.push_back(first);
      choices.back().passes = passes;
    }
  }
  if (choices.empty())
    return refuse_milling(s, to_translate("cutter"), 0, 0, "", listed(reasons), out);
  if (whole) return take(s, choices.front(), out);
  if (!refused_outright(s, choices, out)) choose(s, choices, out);
}

}  // namespace

void add_milled(const PreparedPart& p, std::size_t setup, Clamping clamping,
                const Economy& economy, AuxiliaryWork& out) {
  const MilledPlace* before = nullptr;
  bool made = false;
  for (const auto& m : p.milled_places) {
    if (m.setup.value_or(0) != setup) continue;
    if (before && before->entry == m.entry) {  // alike but for the angle
      if (!made) continue;
      out.after.push_back(out.after.back());
      name_after(m, setup, out.after.back().plan);
      continue;
    }
    const auto operations = out.after.size();
    add(p, m, setup, clamping, economy, out);
    made = out.after.size() > operations;
    before = &m;
  }
}

void add_lobes(const PreparedPart& p, OperationPlan& o) {
  if (!o.milled) return;
  const auto m = std::find_if(p.milled_places.begin(), p.milled_places.end(),
                              [&](const MilledPlace& x) { return x.id == o.on.front(); });
  const auto way = std::find_if(m->ways.begin(), m->ways.end(), [&](const MilledWay& w) {
    return m->cutters[w.cutter].id == o.tool && w.lanes == o.milled->lanes &&
           o.milled->fz_mm <= w.fz_to_mm * (1 + kRounding);
  });
  auto& cut = *o.milled;
  const auto speeds = speeds_rpm(p, m->cutters[way->cutter]);
  const double n = o.passes.front().n_rpm;
  const double low = std::min(n, speeds.lower), high = std::max(n, speeds.upper);
  const double per_mm = (1 + cut.part_share) * cut.Kt_MPa, enough = cut.shown_mm * per_mm;
  MilledCase k;
  k.lobes = way->lobes.get();
  k.between = way->between.get();
  // From the fastest down: where a limit of stability cannot be computed, those of slower
  // speeds cannot either.
  bool told = true;
  for (std::size_t i = kDrawn + 1; i-- > 0;) {
    const double speed = low + (high - low) * static_cast<double>(i) / kDrawn;
    const double stable = told ? stable_to_N_mm(k, speed, enough) : 0;
    told = stable > 0;
    cut.n_rpm.push_back(speed);
    cut.limits_mm.push_back(stable < enough ? std::optional(stable / per_mm)
                                            : std::nullopt);
  }
  std::ranges::reverse(cut.n_rpm);
  std::ranges::reverse(cut.limits_mm);
}

}  // namespace turnwright::planning
