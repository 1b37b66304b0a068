#include "sensitivity.hpp"

#include <algorithm>
#include <cmath>

#include "planning/auxiliary/catalogue_operations.hpp"
#include "planning/setup/setup_planner.hpp"

namespace turnwright::planning {
namespace {

// The tool of the same name, or nothing.
const catalogue::Tool* same(const PreparedPart& p, const catalogue::Tool* tool,
                            bool& found) {
  if (!tool) return nullptr;
  const auto it = std::find_if(p.tools.begin(), p.tools.end(),
                               [&](const auto& t) { return t.id == tool->id; });
  found = found && it != p.tools.end();
  return it == p.tools.end() ? nullptr : &*it;
}

// Cost of a minute, raised by the difference between the changed request and this one.
Economy economy(const PreparedPart& plan, const PreparedPart& changed, Economy e) {
  if (plan.objective != Objective::time)
    e.minute += changed.machine_per_min - plan.machine_per_min;
  return e;
}

// Sets the limits of the tolerances to those of the changed request; false if one has no
// room left.
bool take_limits(const std::vector<CutTolerance>& before,
                 const std::vector<CutTolerance>& after,
                 std::vector<Functional>& functionals) {
  for (auto& g : functionals) {
    const auto in = [&](const std::vector<CutTolerance>& all) {
      return std::find_if(all.begin(), all.end(), [&](const CutTolerance& d) {
        return d.tolerance == g.tolerance;
      });
    };
    const auto old = in(before), now = in(after);
    if (now == after.end() || now->shape != old->shape || !(now->upper > 0)) return false;
    g.limit *= now->upper / old->upper;
    for (auto& [station, weight] : g.terms) weight *= now->factor / old->factor;
  }
  return true;
}

// ln f + sum m g at the answer's conditions, of its own chain or a changed one.
std::optional<double> lagrangian(const SurfaceAnswer& a, const Chain& chain) {
  double sum = 0;
  std::size_t row = 0;
  const double f = evaluate(
      chain, a.choice, [&](std::size_t i, Check check, bool speed, double v, double l) {
        if (row < a.multipliers.size() && a.multipliers[row] > 0)
          sum += a.multipliers[row] * violation({{i, check, speed}, v, l});
        ++row;
      });
  if (row != a.multipliers.size() || !(f > 0)) return {};
  return std::log(f) + sum;
}

// Change of the objective of one surface.
std::optional<double> change(const PreparedPart& plan, const SolvedSurface& f,
                             const PreparedPart& changed,
                             const MachinedSurface& feature) {
  const auto& a = f.answer;
  bool found = true;
  auto recipe = a.model->recipe();
  recipe.rough = same(changed, recipe.rough, found);
  recipe.finish = same(changed, recipe.finish, found);
  auto making = f.task.making;
  making.last = same(changed, making.last, found);
  if (!found || feature.surface() != f.task.feature.surface()) return {};
  std::vector<double> places;
  for (const auto& s : a.model->chain().stations) places.push_back(s.at_mm);
  auto chain =
      feature.chain(recipe, economy(plan, changed, f.task.economy), places, a.choice.a);
  if (!chain) return {};
  chain->functionals = a.model->chain().functionals;
  feature.limit_chatter_alike(a.model->chain(), a.choice.a, *chain);
  if (!take_limits(f.task.cut_tolerances,
                   cut_tolerances(changed, feature.surface(), f.task.offset, making),
                   chain->functionals))
    return {};
  const auto before = lagrangian(a, a.model->chain()), after = lagrangian(a, *chain);
  if (!before || !after) return {};
  return a.objective * (*after - *before);
}

// Change of the objective of a setup apart from its surfaces.
double besides(const PreparedPart& p, const SolvedSetup& s, const AuxiliaryWork& fixed,
               const Economy& e) {
  return e.minute * (besides_cutting(p, s.clamping, s.between).total().time_min +
                     fixed.minutes()) +
         e.edge * fixed.edges_cost();
}

}  // namespace

std::optional<double> first_order(const PreparedPart& plan,
                                  const std::vector<SolvedSetup>& solved,
                                  const PreparedPart& changed) {
  if (changed.setups.size() != solved.size() || changed.objective != plan.objective)
    return {};
  auto done = nothing_finished(changed.drawing);
  double sum = 0;
  for (std::size_t s = 0; s < solved.size(); ++s) {
    const auto& own = solved[s];
    SharedMemory shared;
    const SetupPlanner planner(changed, s, own.clamping, changed.work.setups[s], done, {},
                               shared);
    const auto features = planner.features();
    if (features.size() != own.features.size()) return {};
    for (std::size_t j = 0; j < features.size(); ++j) {
      const auto d = change(plan, own.features[j], changed, *features[j]);
      if (!d) return {};
      sum += *d;
    }
    finish(done, changed.work.setups[s]);
    if (own.features.empty()) continue;
    const auto e = own.features[0].task.economy;
    const auto then = economy(plan, changed, e);
    const auto fixed =
        auxiliary_work(changed, s, own.clamping, changed.work.setups[s], then);
    if (!fixed.conflicts.empty()) return {};
    sum += besides(changed, own, fixed, then) - besides(plan, own, own.auxiliary, e);
  }
  return sum;
}

}  // namespace turnwright::planning
