#include <stdexcept>

#include "pareto.hpp"
#include "planned.hpp"
#include "what_if.hpp"

namespace turnwright::planning {
ProcessPlan plan(const PreparedPart& p, const std::vector<WhatIf>& what_if) {
  if (p.objective == Objective::profit && !p.price)
    throw std::domain_error("plan: the most profitable plan needs a price");
  auto result = planned(p, what_if);
  answer(p, what_if, result);
  if (result.status != PlanStatus::ok) return result;
  if (p.pareto > 0) result.pareto = pareto(p, result);
  return result;
}

ProcessPlan plan(const PlanRequest& request) { return plan(prepare(request)); }

}  // namespace turnwright::planning
