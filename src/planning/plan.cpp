#include "turnwright/planning/plan.hpp"

#include <stdexcept>

#include "certified_plan.hpp"
#include "completed_plan.hpp"
#include "explanation.hpp"
#include "pareto.hpp"
#include "turnwright/planning/prepare.hpp"
#include "what_if.hpp"

namespace turnwright::planning {

ProcessPlan completed_plan(const PreparedPart& p, const std::vector<WhatIf>& what_if,
                           ProcessPlan result) {
  add_explanation(p, result);
  answer(p, what_if, result);
  if (result.status != PlanStatus::ok) return result;
  if (p.pareto > 0) result.pareto = pareto(p, result);
  return result;
}

ProcessPlan plan(const PreparedPart& p, const std::vector<WhatIf>& what_if) {
  if (p.objective == Objective::profit && !p.price)
    throw std::domain_error("plan: the most profitable plan needs a price");
  return completed_plan(p, what_if, certified_plan(p, what_if));
}

ProcessPlan plan(const PlanRequest& request) { return plan(prepare(request)); }

}  // namespace turnwright::planning
