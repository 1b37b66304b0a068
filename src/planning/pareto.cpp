#include "pareto.hpp"

#include <algorithm>
#include <optional>

#include "certified_plan.hpp"
#include "turnwright/planning/prepare.hpp"

namespace turnwright::planning {
namespace {

using Corner = std::optional<ParetoPoint>;

// The plan of least cost + minute time: that of a machine whose minute costs that much
// more.
Corner cheapest(const PreparedPart& p, double minute) {
  PlanRequest dearer = p;
  dearer.objective = Objective::cost;
  dearer.machine_per_min += minute;
  const auto r = certified_plan(prepare(std::move(dearer), p));
  if (r.status != PlanStatus::ok) return {};
  const double time = r.time_per_part_min;
  return ParetoPoint{r.cost_per_part - minute * time, time, minute};
}

Corner fastest(const PreparedPart& p) {
  PlanRequest quick = p;
  quick.objective = Objective::time;
  const auto r = certified_plan(prepare(std::move(quick), p));
  if (r.status != PlanStatus::ok) return {};
  return ParetoPoint{r.cost_per_part, r.time_per_part_min, {}};
}

// The corner of the convex hull of cost against time that a line through two of its
// corners cuts off, and those beyond; nothing cheaper by more than the certificates' gap.
void add_corners(const PreparedPart& p, const ParetoPoint& slow, const ParetoPoint& fast,
                 std::vector<ParetoPoint>& all) {
  constexpr double kWorth = 2e-4;
  const double saved = slow.time_per_part_min - fast.time_per_part_min;
  const double minute = (fast.cost_per_part - slow.cost_per_part) / saved;
  if (!(saved > kWorth * fast.time_per_part_min && minute > 0) || all.size() >= p.pareto)
    return;
  const auto worth = [&](const ParetoPoint& x) {
    return x.cost_per_part + minute * x.time_per_part_min;
  };
  const auto corner = cheapest(p, minute);
  if (!corner || !(worth(*corner) < worth(slow) * (1 - kWorth))) return;
  all.push_back(*corner);
  add_corners(p, slow, *corner, all);
  add_corners(p, *corner, fast, all);
}

// The lower convex hull of points with rising cost: along it time falls, and each further
// minute saved costs more.  Costs are proved to a gap, by which a point can lie off the
// hull; it is left out.
std::vector<ParetoPoint> hull(const std::vector<ParetoPoint>& rising) {
  std::vector<ParetoPoint> kept;
  const auto minute = [](const ParetoPoint& a, const ParetoPoint& b) {
    return (b.cost_per_part - a.cost_per_part) /
           (a.time_per_part_min - b.time_per_part_min);
  };
  constexpr double kOfTime = 1e-9;
  for (const auto& x : rising) {
    if (!kept.empty() &&
        !(x.time_per_part_min < kept.back().time_per_part_min * (1 - kOfTime)))
      continue;
    while (kept.size() > 1 &&
           minute(kept.end()[-2], kept.back()) >= minute(kept.back(), x))
      kept.pop_back();
    kept.push_back(x);
  }
  return kept;
}

}  // namespace

std::vector<ParetoPoint> pareto(const PreparedPart& p, const ProcessPlan& own) {
  const ParetoPoint known{own.cost_per_part, own.time_per_part_min, {}};
  Corner slow = p.objective == Objective::cost ? known : cheapest(p, 0);
  const Corner fast = p.objective == Objective::time ? known : fastest(p);
  if (!slow || !fast) return {};
  slow->minute_worth = 0;
  std::vector<ParetoPoint> all{*slow, *fast};
  add_corners(p, *slow, *fast, all);
  std::sort(all.begin(), all.end(), [](const ParetoPoint& a, const ParetoPoint& b) {
    return a.cost_per_part < b.cost_per_part;
  });
  return hull(all);
}

}  // namespace turnwright::planning
