#include <stdexcept>

#include "pareto.hpp"
#include "planned.hpp"
#include "what_if.hpp"

namespace turnwright::planning {
namespace {

// What a plan would take that keeps its tolerances only nominally.
std::optional<Robustness> robustness(const PreparedPart& p) {
  PlanRequest asked = p;
  asked.robust = false;
  const auto nominal = planned(prepare(std::move(asked), p), {}, Why::untold);
  if (nominal.status != PlanStatus::ok) return {};
  return Robustness{p.conformance, nominal.cost_per_part, nominal.time_per_part_min};
}

}  // namespace

ProcessPlan plan(const PreparedPart& p, const std::vector<WhatIf>& what_if) {
  if (p.objective == Objective::profit && !p.price)
    throw std::domain_error("plan: the most profitable plan needs a price");
  auto result = conforming(p, what_if);
  answer(p, what_if, result);
  if (result.status != PlanStatus::ok) return result;
  if (p.robust) result.robustness = robustness(p);
  if (p.pareto > 0) result.pareto = pareto(p, result);
  return result;
}

ProcessPlan plan(const PlanRequest& request) { return plan(prepare(request)); }

}  // namespace turnwright::planning
