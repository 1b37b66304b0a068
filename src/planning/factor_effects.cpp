#include "turnwright/planning/factor_effects.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "planning/budget/tolerance_allocation.hpp"
#include "turnwright/planning/plan.hpp"
#include "turnwright/planning/prepare.hpp"

namespace turnwright::planning {
namespace {

constexpr double kStep = 1.05;

bool finishes(OperationKind kind) {
  return kind == OperationKind::finish || kind == OperationKind::bore_finish;
}

// Sizes alone, made where they are, within limits so wide that nothing is corrected.
std::vector<part::Tolerance> wide_sizes(const std::vector<part::Tolerance>& tolerances) {
  constexpr double kWide_mm = 10;
  std::vector<part::Tolerance> all;
  for (auto t : tolerances) {
    if (t.kind != part::ToleranceKind::diameter || !t.limits) continue;
    const double middle = (t.limits->lower_mm + t.limits->upper_mm) / 2;
    t.limits = part::Limits{middle - kWide_mm, middle + kWide_mm};
    all.push_back(std::move(t));
  }
  return all;
}

// The request with the plan's own clampings and conditions.
PlanRequest as_planned(const PlanRequest& part, const ProcessPlan& plan) {
  PlanRequest r = part;
  r.drawing.tolerances = wide_sizes(part.drawing.tolerances);
  r.shop.first_part_gauged = false;
  r.milled.clear();
  r.operations.emplace();
  for (std::size_t s = 0; s < plan.setups.size(); ++s) {
    r.setups[s].clampings = {plan.setups[s].clamping};
    for (const auto& o : plan.setups[s].operations) {
      if (is_driven(o.kind) || o.passes.empty()) continue;
      const Pass& pass = o.passes.front();
      r.operations->push_back({o.id,
                               s,
                               o.kind,
                               o.on,
                               o.tool,
                               o.direction,
                               {static_cast<int>(o.passes.size()), pass.ap_mm,
                                pass.f_mm_rev, pass.vc_m_min}});
    }
  }
  return r;
}

void scale_forces(catalogue::Material& m, double factor) {
  catalogue::Thrust t = catalogue::thrust_of(m);
  for (double* x : {&t.ratio, &t.edge_N_mm, &t.land_MPa}) *x *= factor;
  m.thrust = t;
  if (m.kp) m.kp->k11_MPa *= factor;
}

void scale_compliance(catalogue::Lathe& m, double factor) {
  for (auto* root : {&m.chuck.radial, &m.chuck.tangential})
    for (double* x : {&root->c0_mm_N, &root->c1_rad_N, &root->c2_rad_Nmm}) *x *= factor;
  for (auto* at : {&m.tail_centre, &m.head_centre, &m.steady_rest, &m.follow_rest})
    for (double* x : {&at->radial_mm_N, &at->tangential_mm_N}) *x *= factor;
  for (double* x : {&m.chuck.axial_mm_N, &m.tool_rr_mm_N, &m.tool_rt_mm_N}) *x *= factor;
  if (m.tool_zz_mm_N) *m.tool_zz_mm_N *= factor;
}

// The middle of a surface's error on the diameter.
double middle_mm(const Deviation& d) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const auto& [z, e] : d.table_mm) {
    low = std::min(low, e);
    high = std::max(high, e);
  }
  return low + high;
}

using Errors = std::map<std::pair<std::size_t, std::string>, double>;

Errors errors_of(const std::vector<Deviation>& deviations) {
  Errors all;
  for (const auto& d : deviations) all[{d.setup, d.on}] = middle_mm(d);
  return all;
}

// Share of an edge that one part uses of each tool in a setup.
double edges_per_part(const SetupPlan& setup, const std::string& tool) {
  double sum = 0;
  for (const auto& o : setup.operations)
    if (o.tool == tool) sum += o.edges;
  return sum;
}

double wear_mm_part(const PreparedPart& part, const SetupPlan& setup,
                    const OperationPlan& o) {
  const auto tool = std::ranges::find(part.tools, o.tool, &catalogue::Tool::id);
  if (tool == part.tools.end()) return 0;
  const double recession = recession_mm(part, *tool, 1) * edges_per_part(setup, o.tool);
  return 2 * (o.kind == OperationKind::bore_finish ? -recession : recession);
}

}  // namespace

std::vector<FactorEffect> factor_effects(const PreparedPart& part,
                                         const ProcessPlan& plan) {
  if (plan.status != PlanStatus::ok) return {};
  const PlanRequest base = as_planned(part, plan);
  PlanRequest forces = base, compliance = base;
  scale_forces(forces.material, kStep);
  scale_compliance(compliance.machine, kStep);
  const Errors made = errors_of(plan.deviations);
  const Errors raw = errors_of(predict(base).deviations),
               by_force = errors_of(predict(forces).deviations),
               by_compliance = errors_of(predict(compliance).deviations);
  std::vector<FactorEffect> all;
  for (std::size_t s = 0; s < plan.setups.size(); ++s)
    for (const auto& o : plan.setups[s].operations) {
      if (!finishes(o.kind)) continue;
      for (const auto& surface : o.on) {
        const std::pair at{s, surface};
        if (!made.contains(at) || !raw.contains(at)) continue;
        const double step = std::log(kStep);
        all.push_back({surface, o.tool, s, made.at(at),
                       (by_force.at(at) - raw.at(at)) / step,
                       (by_compliance.at(at) - raw.at(at)) / step,
                       wear_mm_part(part, plan.setups[s], o),
                       edges_per_part(plan.setups[s], o.tool)});
      }
    }
  return all;
}

}  // namespace turnwright::planning
