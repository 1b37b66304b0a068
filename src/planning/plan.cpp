#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "setup_planner.hpp"
#include "usable.hpp"

namespace turnwright::planning {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kBeyondRounding = 1e-6;

struct Comparison {
  SolvedSetup chosen;
  std::vector<RejectedClamping> rejected;
  bool solved = false;
};

// What a setup takes, in the terms of the objective.
std::string takes(const PartPlan& p, const Totals& t) {
  if (p.objective == Objective::time) return fmt::format("{:.4f} min", t.minutes);
  if (p.objective == Objective::profit)
    return fmt::format("{:.4f} in {:.4f} min", t.cost, t.minutes);
  return fmt::format("{:.4f}", t.cost);
}

// Why a clamping loses to the best one.
RejectedClamping rejection(const PartPlan& p, const SolvedSetup& s,
                           const SolvedSetup& best) {
  const char* verb = p.objective == Objective::time ? "takes" : "costs";
  const auto least = takes(p, totals(p, best));
  if (s.feasible()) {
    const auto t = totals(p, s);
    return {s.clamping,
            fmt::format("{} {} against {} for this setup", verb, takes(p, t), least),
            t.cost};
  }
  const auto f = std::find_if(s.features.begin(), s.features.end(),
                              [](const auto& x) { return !x.answer.feasible; });
  SolvedFeature shown = *f;
  if (!shown.answer.model) shown.answer = nearest(shown.task);
  if (!shown.answer.model || shown.answer.least_violation > kBeyondRounding)
    return {s.clamping, obstacle(p, shown), {}};
  return {s.clamping, fmt::format("cannot do better than {} for this setup", least), {}};
}

// The best of some clampings of one setup, each with its planner.
std::vector<SolvedSetup> best_of_each(std::vector<SetupPlanner>& planners) {
  std::vector<SolvedSetup> all;
  double most = kInfinity;
  for (auto& planner : planners) {
    all.push_back(planner.best(most));
    if (all.back().feasible()) most = std::min(most, all.back().objective);
  }
  return all;
}

// The stiffer clampings first: what a slender part could do in the chuck alone then has a
// cost to beat, which is quicker to refute than that it can be made at all.
// Compensation is proposed only where no clamping does without.
Comparison compare_clampings(const PartPlan& p, std::size_t setup, const SetupWork& work,
                             const Finished& done, Economy economy) {
  Comparison result;
  FaceMemory faces;
  std::vector<SetupPlanner> planners;
  auto clampings = p.setups[setup].clampings;
  std::stable_partition(clampings.begin(), clampings.end(),
                        [](Clamping c) { return c != Clamping::chuck; });
  for (const Clamping c : clampings) {
    const auto why = unusable(p, setup, c, work, done);
    if (!why.empty())
      result.rejected.push_back({c, why, {}});
    else
      planners.emplace_back(p, setup, c, work, done, economy, faces);
  }
  if (planners.empty()) return result;
  auto all = best_of_each(planners);
  if (std::none_of(all.begin(), all.end(), [](const auto& s) { return s.feasible(); })) {
    for (auto& planner : planners) planner.allow_compensation();
    all = best_of_each(planners);
  }
  const auto best = std::min_element(
      all.begin(), all.end(), [](const SolvedSetup& a, const SolvedSetup& b) {
        return a.feasible() != b.feasible() ? a.feasible() : a.objective < b.objective;
      });
  double bound = kInfinity;
  for (const auto& s : all) {
    bound = std::min(bound, s.lower_bound);
    if (&s != &*best) result.rejected.push_back(rejection(p, s, *best));
  }
  result.chosen =
      best->feasible()
          ? *best
          : planners[static_cast<std::size_t>(best - all.begin())].explained();
  result.chosen.lower_bound = bound;
  result.solved = true;
  return result;
}

Economy economy_of(const PartPlan& p, double profit_rate) {
  switch (p.objective) {
    case Objective::cost:
      return {p.machine_per_min, 1};
    case Objective::time:
      return {1, 0};
    case Objective::profit:
      return {p.machine_per_min + profit_rate, 1};
  }
  return {};
}

struct Attempt {
  std::vector<Comparison> setups;
  bool feasible = true;
  Totals total;
  double objective = 0, lower_bound = 0;
};

Attempt attempt(const PartPlan& p, const Assignment& work, Economy economy) {
  Attempt a;
  auto done = nothing_finished(p.drawing);
  for (std::size_t s = 0; s < p.setups.size(); ++s) {
    a.setups.push_back(compare_clampings(p, s, work.setups[s], done, economy));
    const auto& c = a.setups.back();
    a.feasible = a.feasible && c.solved && c.chosen.feasible();
    finish(done, work.setups[s]);
    if (!c.solved) a.lower_bound = kInfinity;
    if (!c.solved) continue;
    const auto t = totals(p, c.chosen);
    a.total.minutes += t.minutes;
    a.total.cost += t.cost;
    a.objective += c.chosen.objective;
    a.lower_bound += c.chosen.lower_bound;
  }
  return a;
}

// Dinkelbach: the profit rate R is best when min C + R t equals the price; each step
// takes the R of the plan before, which rises until the certificates' gap hides what is
// left.  A part that earns nothing at least cost is made at least cost.
Attempt best_attempt(const PartPlan& p, const Assignment& work) {
  constexpr double kRises = 1e-6;
  auto best = attempt(p, work, economy_of(p, 0));
  if (p.objective != Objective::profit) return best;
  const auto rate = [&](const Attempt& a) {
    return (*p.price - a.total.cost) / a.total.minutes;
  };
  while (best.feasible && rate(best) > 0) {
    auto next = attempt(p, work, economy_of(p, rate(best)));
    if (!next.feasible || !(rate(next) > rate(best) * (1 + kRises))) {
      next.lower_bound = std::min(next.lower_bound, next.objective);
      best.objective = best.total.cost + rate(best) * best.total.minutes;
      best.lower_bound = next.lower_bound;
      break;
    }
    best = std::move(next);
  }
  return best;
}

Certificate total_certificate(const Attempt& a) {
  Certificate c;
  c.kind = CertificateKind::global;
  std::set<std::string> engines;
  for (const auto& s : a.setups)
    for (const auto& f : s.chosen.features) {
      const auto& k = f.answer.certificate;
      c.nodes += k.nodes;
      engines.insert(k.engine);
      if (k.kind != CertificateKind::global) {
        c.kind = k.kind;
        c.reason = f.task.feature.surface() + ": " + k.reason;
      }
    }
  for (const auto& e : engines) c.engine += (c.engine.empty() ? "" : " and ") + e;
  c.lower_bound = std::min(a.lower_bound, a.objective);
  c.gap = a.objective > 0 ? 1 - c.lower_bound / a.objective : 0;
  if (c.kind == CertificateKind::global && c.gap > kCertified) {
    c.kind = CertificateKind::local;
    c.reason =
        "with other tools or another clamping the budget of boxes ended before "
        "every box was settled";
  }
  return c;
}

Certificate no_certificate(const Attempt& a) {
  Certificate c;
  c.reason =
      a.lower_bound < kInfinity
          ? "no plan was found, but the budget of boxes ended before every box was "
            "settled"
          : "proved: no plan keeps every limit";
  for (const auto& s : a.setups)
    for (const auto& f : s.chosen.features) c.nodes += f.answer.certificate.nodes;
  return c;
}

SetupPlan setup_plan(const PartPlan& p, std::size_t index, const Comparison& c,
                     ProcessPlan& result) {
  SetupPlan s;
  s.hold = p.setups[index].hold;
  s.rejected = c.rejected;
  if (!c.solved) {
    for (const auto& r : c.rejected)
      result.conflicts.push_back({"clamping", fmt::format("setup {}", index), 0, 0, "",
                                  std::string(name(r.clamping)) + ": " + r.why});
    return s;
  }
  s.clamping = c.chosen.clamping;
  s.grip_force_N = jaw_force_N(p, index, s.clamping, Stage::roughing);
  s.finishing_grip_force_N = jaw_force_N(p, index, s.clamping, Stage::finishing);
  for (const auto& f : c.chosen.features)
    if (!f.answer.feasible) explain(p, c.chosen, f, result);
  s.operations = operations_in_order(p, c.chosen);
  return s;
}

ProcessPlan planned(const PartPlan& p) {
  ProcessPlan result;
  const auto work = assign(p);
  add_obstacles(p, work, result);
  if (!result.conflicts.empty()) {
    result.status = PlanStatus::infeasible;
    result.certificate.reason = "proved: no condition or tool changes the conflicts told";
    return result;
  }
  const auto a = best_attempt(p, work);
  std::vector<SolvedSetup> chosen;
  for (std::size_t s = 0; s < a.setups.size(); ++s) {
    result.setups.push_back(setup_plan(p, s, a.setups[s], result));
    chosen.push_back(a.setups[s].chosen);
  }
  if (!a.feasible) {
    result.status = PlanStatus::infeasible;
    result.certificate = no_certificate(a);
    return result;
  }
  result.tolerances = tolerance_results(p, chosen);
  result.cost_per_part = a.total.cost;
  result.time_per_part_min = a.total.minutes;
  if (p.price) result.profit_per_min = (*p.price - a.total.cost) / a.total.minutes;
  result.certificate = total_certificate(a);
  result.deviations = deviations(chosen);
  result.compensation = compensations(chosen);
  result.prices = prices(p, chosen);
  return result;
}

// From the deviation of a size that goes furthest to the one at its other end, as a share
// of it; both ends alike of what has no two ends.
double other_end(const part::Tolerance& t, const ToleranceResult& r) {
  if (t.kind != part::ToleranceKind::diameter) return -1;
  const double middle = (t.limits->upper_mm + t.limits->lower_mm) / 2;
  const double low = r.predicted_mm[0] - middle, high = r.predicted_mm[1] - middle;
  return std::abs(low) > std::abs(high) ? high / low : low / high;
}

// Sizes that fail at their other limit too are asked for what that takes, (2) of
// allowance.hpp, until all conform; past some rounds as if their errors had both signs.
ProcessPlan robust_plan(PartPlan p) {
  constexpr int kRounds = 4;
  constexpr double kConforms = 1e-6;
  auto result = planned(p);
  for (int round = 0; round <= kRounds && result.status == PlanStatus::ok; ++round) {
    bool all = true;
    for (std::size_t i = 0; i < result.tolerances.size(); ++i) {
      const auto& r = result.tolerances[i];
      if (r.P_conform >= p.conformance - kConforms) continue;
      all = false;
      p.other_ends[i] = round < kRounds ? other_end(p.drawing.tolerances[i], r) : -1;
    }
    if (all) break;
    result = planned(p);
  }
  if (result.status != PlanStatus::ok) return result;
  auto nominal = p;
  nominal.robust = false;
  const auto n = planned(nominal);
  if (n.status == PlanStatus::ok)
    result.robustness = Robustness{p.conformance, n.cost_per_part, n.time_per_part_min};
  return result;
}

}  // namespace

ProcessPlan plan(const PartPlan& p) { return p.robust ? robust_plan(p) : planned(p); }

}  // namespace turnwright::planning
