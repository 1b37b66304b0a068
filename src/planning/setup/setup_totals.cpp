#include "setup_totals.hpp"

namespace turnwright::planning {

Breakdown breakdown(const PreparedPart& p, const SolvedSetup& s) {
  auto b = besides_cutting(p, s.clamping, s.between);
  for (const auto& f : s.features) {
    if (!f.answer.feasible) continue;
    const auto u = spent(f.answer);
    b.cutting.time_min += u.cut_min;
    b.air.time_min += u.air_min;
    b.edges.time_min += u.change_min;
    b.edges.cost += u.edges_cost;
  }
  for (const auto& o : s.auxiliary.all()) {
    b.cutting.time_min += o.plan.time_min;
    b.air.time_min += o.air_min;
    b.edges.time_min += o.change_min;
    b.edges.cost += o.edges_cost;
  }
  for (const auto share : kSpendings)
    (b.*share).cost += p.machine_per_min * (b.*share).time_min;
  return b;
}

void add_totals(const PreparedPart& p, ProcessPlan& result) {
  const auto total = result.breakdown.total();
  result.cost_per_part = total.cost;
  result.time_per_part_min = total.time_min;
  if (p.price) result.profit_per_min = (*p.price - total.cost) / total.time_min;
}

SettingUp setting_up(const PlanRequest& p) {
  SettingUp all;
  all.minutes = static_cast<double>(p.setups.size()) * p.machine.setup_min;
  all.cost = p.machine_per_min * all.minutes;
  if (!p.batch) return all;
  all.minutes_per_part = all.minutes / *p.batch;
  all.cost_per_part = all.cost / *p.batch;
  return all;
}

}  // namespace turnwright::planning
