#include "clamping_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/say.hpp"
#include "infeasibility_reason.hpp"
#include "planning/clamping/clamping_checks.hpp"
#include "planning/values/side_by_side.hpp"
#include "setup_planner.hpp"
#include "setup_totals.hpp"
#include "turnwright/base/interval.hpp"

namespace turnwright::planning {
namespace {

constexpr double kBeyondRounding = 1e-6;

// Time or cost of a setup in the terms of the objective.
std::string takes(const PreparedPart& p, const Spending& t) {
  if (p.objective == Objective::time) return fmt::format("{:.4f} min", t.time_min);
  if (p.objective == Objective::profit)
    return say("{:.4f} in {:.4f} min", t.cost, t.time_min);
  return fmt::format("{:.4f}", t.cost);
}

// The reason why a clamping is not chosen.
RejectedClamping rejection(const PreparedPart& p, const SolvedSetup& s,
                           const SolvedSetup& best) {
  const auto least = takes(p, breakdown(p, best).total());
  if (s.feasible()) {
    const auto t = breakdown(p, s).total();
    return {s.clamping,
            p.objective == Objective::time
                ? say("takes {} against {} for this setup", takes(p, t), least)
                : say("costs {} against {} for this setup", takes(p, t), least),
            t.cost};
  }
  const auto f = std::find_if(s.features.begin(), s.features.end(),
                              [](const auto& x) { return !x.answer.feasible; });
  SolvedSurface shown = *f;
  if (!shown.answer.model) shown.answer = nearest(shown.task);
  if (!shown.answer.model || shown.answer.least_violation > kBeyondRounding)
    return {s.clamping, infeasibility_reason(p, shown), {}};
  return {s.clamping, say("cannot do better than {} for this setup", least), {}};
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

// Stiffer clampings come first: a slender part in the chuck alone then has a cost to
// beat, which is quicker to refute than its feasibility.
// Compensation is proposed only where every clamping needs it.
Comparison compare_clampings(const PreparedPart& p, std::size_t setup,
                             const SetupWork& work, const Finished& done,
                             Economy economy) {
  Comparison result;
  SharedMemory shared;
  std::vector<SetupPlanner> planners;
  auto clampings = p.setups[setup].clampings;
  std::stable_partition(clampings.begin(), clampings.end(),
                        [](Clamping c) { return c != Clamping::chuck; });
  for (const Clamping c : clampings) {
    auto why = unusable(p, setup, c, work, done);
    if (why.empty()) {
      planners.emplace_back(p, setup, c, work, done, economy, shared);
      for (const auto& one : planners.back().conflicts())
        why += (why.empty() ? "" : "; ") + one.sentence;
      if (why.empty()) continue;
      planners.pop_back();
    }
    result.rejected.push_back({c, why, {}});
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

Economy economy_of(const PreparedPart& p, double profit_rate) {
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

}  // namespace

Attempt attempt(const PreparedPart& p, Economy economy) {
  Attempt a;
  a.breakdown.stock.cost = p.stock_price;
  a.objective = a.lower_bound = economy.edge * p.stock_price;
  std::vector<Finished> before{nothing_finished(p.drawing)};
  for (const auto& work : p.work.setups) {
    before.push_back(before.back());
    finish(before.back(), work);
  }
  a.setups.resize(p.setups.size());
  side_by_side(p.setups.size(), [&](std::size_t s) {
    a.setups[s] = compare_clampings(p, s, p.work.setups[s], before[s], economy);
  });
  for (const auto& c : a.setups) {
    a.feasible = a.feasible && c.solved && c.chosen.feasible();
    if (!c.solved) a.lower_bound = kInfinity;
    if (!c.solved) continue;
    a.breakdown += breakdown(p, c.chosen);
    a.objective += c.chosen.objective;
    a.lower_bound += c.chosen.lower_bound;
  }
  return a;
}

// [Dinkelbach 1967]: the profit rate R is greatest when min C + R t equals the price.
// Each step minimises with the R of the plan before; R rises until a further rise would
// be hidden by the gap of the certificates.  A part that earns nothing at its least cost
// is made at that cost.
Attempt best_attempt(const PreparedPart& p) {
  constexpr double kRises = 1e-6;
  auto best = attempt(p, economy_of(p, 0));
  if (p.objective != Objective::profit) return best;
  const auto rate = [&](const Attempt& a) {
    const auto total = a.breakdown.total();
    return (*p.price - total.cost) / total.time_min;
  };
  while (best.feasible && rate(best) > 0) {
    auto next = attempt(p, economy_of(p, rate(best)));
    if (!next.feasible || !(rate(next) > rate(best) * (1 + kRises))) {
      next.lower_bound = std::min(next.lower_bound, next.objective);
      const auto total = best.breakdown.total();
      best.objective = total.cost + rate(best) * total.time_min;
      best.lower_bound = next.lower_bound;
      break;
    }
    best = std::move(next);
  }
  return best;
}

}  // namespace turnwright::planning
