#include "explanation.hpp"

#include "planning/explain/conflict_report.hpp"
#include "planning/setup/clamping_comparison.hpp"
#include "remedies.hpp"

namespace turnwright::planning {

void add_explanation(const PreparedPart& p, ProcessPlan& result) {
  if (result.status == PlanStatus::ok) return;
  if (result.setups.empty()) return add_remedies(p, nullptr, result);
  const auto best = best_attempt(p);
  if (best.feasible) return add_remedies(p, nullptr, result);
  explain(p, best, result);
  add_remedies(p, &best, result);
}

}  // namespace turnwright::planning
