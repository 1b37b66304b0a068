#include "explanation.hpp"

#include <algorithm>

#include "planning/explain/conflict_report.hpp"
#include "planning/explain/stations.hpp"
#include "planning/setup/clamping_comparison.hpp"
#include "remedies.hpp"

namespace turnwright::planning {

void add_explanation(const PreparedPart& p, ProcessPlan& result) {
  if (result.status == PlanStatus::ok) return;
  if (result.setups.empty()) return add_remedies(p, nullptr, result);
  const auto best = best_attempt(p);
  if (best.feasible) return add_remedies(p, nullptr, result);
  explain(p, best, result);
  if (std::ranges::any_of(best.setups,
                          [](const Comparison& c) { return c.chosen.short_of_stations; }))
    add_lack_of_stations(p, result);
  add_remedies(p, &best, result);
}

}  // namespace turnwright::planning
