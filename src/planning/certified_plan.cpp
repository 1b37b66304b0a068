#include "certified_plan.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/say.hpp"
#include "planning/explain/given_operations.hpp"
#include "planning/explain/prices.hpp"
#include "planning/explain/sensitivity.hpp"
#include "planning/explain/stock_conflicts.hpp"
#include "planning/setup/clamping_comparison.hpp"
#include "planning/setup/edge_schedule.hpp"
#include "planning/setup/operation_order.hpp"
#include "planning/setup/setup_totals.hpp"
#include "planning/setup/tolerance_verdicts.hpp"
#include "planning/values/readable.hpp"
#include "turnwright/base/interval.hpp"

namespace turnwright::planning {
namespace {

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
  for (const auto& s : a.setups)
    for (const auto& o : s.chosen.auxiliary.all()) {
      c.lower_bound -= o.open;
      if (o.plan.certificate.kind == CertificateKind::global) continue;
      c.kind = o.plan.certificate.kind;
      c.reason = o.plan.id + ": " + o.plan.certificate.reason;
    }
  c.gap = a.objective > 0 ? 1 - c.lower_bound / a.objective : 0;
  if (c.kind == CertificateKind::global && c.gap > kCertified) {
    c.kind = CertificateKind::local;
    c.reason =
        tr("with other tools or another clamping the budget of boxes ended before "
           "every box was settled");
  }
  return c;
}

Certificate no_certificate(const Attempt& a) {
  Certificate c;
  c.reason =
      a.lower_bound < kInfinity
          ? say("no plan was found, but it is not proved that there is none: {}",
                tr("the budget of boxes ended before every box was settled, or with a "
                   "corrected path the sizes were kept by none of the conditions that "
                   "were tried"))
          : tr("proved: no plan keeps every limit");
  for (const auto& s : a.setups)
    for (const auto& f : s.chosen.features) c.nodes += f.answer.certificate.nodes;
  return c;
}

SetupPlan setup_plan(const PreparedPart& p, std::size_t index, const Comparison& c,
                     ProcessPlan& result) {
  SetupPlan s;
  s.hold = p.setups[index].hold;
  s.rejected = c.rejected;
  s.rejected_tools = c.chosen.rejected_tools;
  if (!c.solved) {
    for (const auto& r : c.rejected)
      result.conflicts.push_back({to_translate("clamping"), setup_label(index), 0, 0, "",
                                  tr(name(r.clamping)) + ": " + r.why});
    return s;
  }
  s.clamping = c.chosen.clamping;
  s.grip_force_N = jaw_force_N(p, index, s.clamping, Stage::roughing);
  s.finishing_grip_force_N = jaw_force_N(p, index, s.clamping, Stage::finishing);
  s.operations = operations_in_order(p, c.chosen);
  return s;
}

// Tolerances that the corrected path, judged as it is cut, does not keep, or edges that are
// newer, where the plan was made for those due for change.
bool add_missed(const PreparedPart& p, ProcessPlan& result) {
  const bool worn = p.shop.edge_wear_mm > 0;
  for (const auto& t : result.tolerances) {
    if (t.verdict != Verdict::not_met) continue;
    result.conflicts.push_back({t.id + " " + part::name(t.kind), t.of,
                                t.allowed_mm.back() - t.margin_mm, t.allowed_mm.back(),
                                "mm",
                                say("{} of {} is {} mm outside its limits {}", t.id, t.of,
                                    readable(-t.margin_mm),
                                    worn ? tr("with edges that are not yet due")
                                         : tr("even with the path corrected"))});
  }
  if (result.conflicts.empty()) return false;
  result.status = PlanStatus::infeasible;
  result.cost_per_part = result.time_per_part_min = 0;
  result.breakdown = {};
  for (auto& s : result.setups) s.breakdown = {};
  result.profit_per_min.reset();
  result.certificate = {};
  result.certificate.reason =
      worn ? tr("no plan was found: what worn edges keep, newer ones do not")
           : tr("no plan was found: even a corrected tool path does not keep every "
                "tolerance");
  return true;
}

std::optional<double> first_order_saving(const PreparedPart& p,
                                         const std::vector<SolvedSetup>& solved,
                                         const PreparedPart& changed) {
  const auto costs = first_order(p, solved, changed);
  if (!costs) return {};
  return -*costs;
}

Shortfall shortfall(const Attempt& a) {
  Shortfall s;
  for (const auto& setup : a.setups) {
    s.unsolved = s.unsolved || !setup.solved;
    for (const auto& f : setup.chosen.features) {
      if (f.answer.feasible) continue;
      ++s.missed;
      if (f.answer.model) s.violation += f.answer.least_violation;
    }
  }
  return s;
}

}  // namespace

double objective(const PreparedPart& p, const ProcessPlan& plan) {
  switch (p.objective) {
    case Objective::time:
      return plan.time_per_part_min;
    case Objective::profit:
      return -plan.profit_per_min.value_or(0);
    case Objective::cost:
      break;
  }
  return plan.cost_per_part;
}

bool is_better(const PreparedPart& p, const ProcessPlan& plan, const ProcessPlan& other) {
  return plan.status == PlanStatus::ok &&
         (other.status != PlanStatus::ok || objective(p, plan) < objective(p, other));
}

ProcessPlan certified_plan(const PreparedPart& p, const std::vector<WhatIf>& what_if) {
  return nearest_plan(p, what_if).plan;
}

NearestPlan nearest_plan(const PreparedPart& p, const std::vector<WhatIf>& what_if) {
  NearestPlan nearest;
  auto& result = nearest.plan;
  for (const auto& w : what_if) result.what_if.emplace_back().name = w.name;
  add_unreachable(p, result);
  add_used_up(p, tolerances_left_to_the_stock(p), result);
  add_auxiliary_conflicts(p, result);
  if (result.conflicts.empty()) add_left_out(p, result);
  if (!result.conflicts.empty()) {
    result.status = PlanStatus::infeasible;
    result.certificate.reason =
        tr("no conditions of turning and boring can resolve the conflicts");
    nearest.shortfall.unsolved = true;
    return nearest;
  }
  const auto a = best_attempt(p);
  std::vector<SolvedSetup> chosen;
  for (std::size_t s = 0; s < a.setups.size(); ++s) {
    result.setups.push_back(setup_plan(p, s, a.setups[s], result));
    chosen.push_back(a.setups[s].chosen);
  }
  if (!a.feasible) {
    result.status = PlanStatus::infeasible;
    result.certificate = no_certificate(a);
    nearest.shortfall = shortfall(a);
    return nearest;
  }
  result.tolerances = tolerance_results(p, chosen);
  result.worst_conformance = worst_conformance(p, result.tolerances);
  result.setting_up = setting_up(p);
  result.breakdown = a.breakdown;
  for (std::size_t s = 0; s < chosen.size(); ++s)
    result.setups[s].breakdown = breakdown(p, chosen[s]);
  add_totals(p, result);
  result.certificate = total_certificate(a);
  if (add_missed(p, result)) {
    nearest.shortfall.missed = result.conflicts.size();
    return nearest;
  }
  result.deviations = deviations(p, chosen);
  result.offsets = offsets(p, chosen);
  result.compensation = compensations(chosen);
  for (std::size_t s = 0; s < chosen.size(); ++s)
    result.setups[s].edges =
        edge_schedules(p, chosen[s], result.setups[s].operations, result.offsets);
  result.prices = prices(p, chosen);
  for (std::size_t k = 0; k < what_if.size(); ++k)
    result.what_if[k].first_order_saves_per_part =
        first_order_saving(p, chosen, what_if[k].part);
  return nearest;
}

}  // namespace turnwright::planning
