#include <algorithm>
#include <limits>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>

#include "planning/clamping/clamping_checks.hpp"
#include "planning/explain/given_operations.hpp"
#include "planning/explain/stock_conflicts.hpp"
#include "planning/setup/edge_schedule.hpp"
#include "planning/setup/infeasibility_reason.hpp"
#include "planning/setup/operation_order.hpp"
#include "planning/setup/setup_planner.hpp"
#include "planning/setup/setup_totals.hpp"
#include "planning/setup/tolerance_verdicts.hpp"
#include "planning/values/readable.hpp"
#include "turnwright/base/language.hpp"
#include "turnwright/planning/plan.hpp"
#include "turnwright/planning/prepare.hpp"

namespace turnwright::planning {
namespace {

constexpr double kBeyondRounding = 1e-9;

double worst_violation(const RecipeModel& m, const Choice<double>& c) {
  double worst = -std::numeric_limits<double>::infinity();
  for (const auto& row : m.values(c)) worst = std::max(worst, violation(row));
  return worst;
}

// The answer at given conditions: in the cheapest speed ranges that keep every limit, as a
// plan would choose them, or in those that violate the limits least.
SurfaceAnswer as_given(const SurfaceTask& task) {
  SurfaceAnswer a;
  std::pair best{std::numeric_limits<double>::infinity(), 0.0};
  const auto& fixed = task.feature.fixed();
  for (const auto& recipe : task.recipes) {
    auto chain = task.feature.chain(recipe, task.economy, {});
    if (!chain) continue;
    Choice<double> c{{1, 1}, {1, 1}, chain->a.lower};
    for (std::size_t i = 0; i < chain->operations.size(); ++i) {
      const auto& given = chain->operations[i].finishing ? fixed.finish : fixed.rough;
      c.v[i] = *given.vc_m_min;
      c.f[i] = *given.f_mm_rev;
    }
    auto m = std::make_shared<RecipeModel>(recipe, std::move(*chain));
    const double worst = worst_violation(*m, c);
    const std::pair rank{std::max(worst, kBeyondRounding), m->objective(c)};
    if (!(rank < best)) continue;
    best = rank;
    a.feasible = true;
    a.least_violation = worst;
    a.choice = c;
    a.model = std::move(m);
  }
  if (!a.model) return a;
  a.objective = a.model->objective(a.choice);
  a.multipliers.assign(a.model->rows().size(), 0);
  a.profile = task.feature.profile(a.model->recipe(), task.economy, a.choice);
  a.certificate.reason = tr("conditions as given");
  return a;
}

void add_broken(const SetupPlan& setup, std::size_t index, ProcessPlan& result) {
  for (const auto& o : setup.operations)
    for (const auto& c : o.constraints)
      if (c.margin < -kBeyondRounding)
        result.conflicts.push_back({c.name, setup_label(index) + ", " + o.id, c.value,
                                    c.limit, c.unit, exceeded(o.id, c)});
}

// Whether every setup's clamping can be used; if not, adds the reason.
bool held(const PreparedPart& p, ProcessPlan& result) {
  auto done = nothing_finished(p.drawing);
  bool all = true;
  for (std::size_t s = 0; s < p.setups.size(); ++s) {
    const auto clamping = p.setups[s].clampings.front();
    const auto why = unusable(p, s, clamping, p.work.setups[s], done);
    finish(done, p.work.setups[s]);
    if (why.empty()) continue;
    all = false;
    result.conflicts.push_back(
        {"clamping", setup_label(s), 0, 0, "", tr(name(clamping)) + ": " + why});
  }
  return all;
}

std::vector<SolvedSetup> solved(const PreparedPart& p,
                                const std::set<std::string>& corrected) {
  auto done = nothing_finished(p.drawing);
  std::vector<SolvedSetup> all;
  for (std::size_t s = 0; s < p.setups.size(); ++s) {
    SharedMemory shared;
    SetupPlanner planner(p, s, p.setups[s].clampings.front(), p.work.setups[s], done,
                         {p.machine_per_min, 1}, shared);
    all.push_back(planner.as_given(as_given, corrected));
    finish(done, p.work.setups[s]);
  }
  return all;
}

SetupPlan setup_plan(const PreparedPart& p, std::size_t s, const SolvedSetup& solved,
                     ProcessPlan& result) {
  SetupPlan setup;
  setup.hold = p.setups[s].hold;
  setup.clamping = p.setups[s].clampings.front();
  setup.grip_force_N = jaw_force_N(p, s, setup.clamping, Stage::roughing);
  setup.finishing_grip_force_N = jaw_force_N(p, s, setup.clamping, Stage::finishing);
  setup.operations = operations_in_order(p, solved);
  for (const auto& f : solved.features)
    if (!f.answer.model)
      result.conflicts.push_back(
          {"depth of cut", setup_label(s), 0, 0, "mm", infeasibility_reason(p, f)});
  const auto& missing = solved.auxiliary.conflicts;
  result.conflicts.insert(result.conflicts.end(), missing.begin(), missing.end());
  add_broken(setup, s, result);
  return setup;
}

// The surfaces of tolerances that are not met.
std::set<std::string> missed(const PreparedPart& p,
                             const std::vector<ToleranceResult>& tolerances) {
  std::set<std::string> all;
  for (std::size_t i = 0; i < tolerances.size(); ++i) {
    if (tolerances[i].verdict != Verdict::not_met) continue;
    const auto& t = p.drawing.tolerances[i];
    if (t.kind == part::ToleranceKind::length)
      all.insert(t.between.begin(), t.between.end());
    else
      all.insert(t.of);
  }
  return all;
}

bool feasible(const std::vector<SolvedSetup>& setups) {
  return std::all_of(setups.begin(), setups.end(), [](auto& s) { return s.feasible(); });
}

// The surfaces that keep their tolerances with a corrected path and not without.  A path
// is corrected for one force, not for all from a new edge to a worn one.
std::vector<SolvedSetup> with_corrections(const PreparedPart& p) {
  auto plain = solved(p, {});
  if (!feasible(plain) || p.shop.edge_wear_mm > 0) return plain;
  auto surfaces = missed(p, tolerance_results(p, plain));
  if (surfaces.empty()) return plain;
  const auto corrected = solved(p, surfaces);
  for (const auto& left : missed(p, tolerance_results(p, corrected)))
    surfaces.erase(left);
  for (const auto& setup : corrected)
    for (const auto& f : setup.features)
      if (worst_excess(f.task.cut_tolerances, f.answer.profile) > kBeyondRounding)
        surfaces.erase(f.task.feature.surface());
  return surfaces.empty() ? plain : solved(p, surfaces);
}

void require(bool holds, const std::string& rule) {
  if (!holds) throw std::domain_error("predict: " + rule);
}

void require_given(const PreparedPart& p) {
  for (const auto& setup : p.setups)
    require(!setup.clampings.empty(), "each setup needs a clamping");
  require(p.operations.has_value(), "the operations must be given");
  for (const auto& o : *p.operations)
    require(o.kind == OperationKind::fixed || o.kind == OperationKind::mill ||
                (o.conditions.vc_m_min && o.conditions.f_mm_rev),
            o.id + " must have speed and feed");
}

}  // namespace

ProcessPlan predict(const PreparedPart& p) {
  require_given(p);
  ProcessPlan result;
  add_unreachable(p, result);
  std::vector<std::size_t> every(p.drawing.tolerances.size());
  std::iota(every.begin(), every.end(), 0);
  add_used_up(p, every, result);
  if (!held(p, result)) {
    result.status = PlanStatus::infeasible;
    result.certificate.reason = tr("nothing to predict: the part cannot be held so");
    return result;
  }
  add_left_out(p, result);
  const auto setups = with_corrections(p);
  for (std::size_t s = 0; s < setups.size(); ++s)
    result.setups.push_back(setup_plan(p, s, setups[s], result));
  result.certificate.reason = tr("conditions as given");
  if (feasible(setups)) {
    result.tolerances = tolerance_results(p, setups);
    result.worst_conformance = worst_conformance(p, result.tolerances);
    result.setting_up = setting_up(p);
    result.deviations = deviations(p, setups);
    result.offsets = offsets(p, setups);
    result.compensation = compensations(setups);
    result.breakdown.stock.cost = p.stock_price;
    for (std::size_t s = 0; s < setups.size(); ++s) {
      result.setups[s].breakdown = breakdown(p, setups[s]);
      result.setups[s].edges =
          edge_schedules(p, setups[s], result.setups[s].operations, result.offsets);
      result.breakdown += result.setups[s].breakdown;
    }
    add_totals(p, result);
  }
  if (!result.conflicts.empty()) result.status = PlanStatus::infeasible;
  return result;
}

ProcessPlan predict(const PlanRequest& request) { return predict(prepare(request)); }

}  // namespace turnwright::planning
