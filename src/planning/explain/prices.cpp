#include "prices.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/say.hpp"
#include "binding_limits.hpp"
#include "planning/values/readable.hpp"
#include "sensitivity.hpp"
#include "turnwright/planning/limit.hpp"
#include "turnwright/planning/prepare.hpp"

namespace turnwright::planning {
namespace {

constexpr double kWorthNaming = 1e-7;  // of the objective: below it a price is rounding
constexpr double kStep = 1e-5;         // of a limit: its square is far below 1 %
const double kTenPercent = std::log(1.1);

const char* unit_of_objective(const PreparedPart& p) {
  return p.objective == Objective::time ? " min" : "";
}

// Limits that hold some operation, with the operations.
using Binding = std::map<std::string, std::vector<std::string>>;

void add(const std::vector<std::string>& names, const std::string& operation,
         Binding& all) {
  for (const auto& name : names) {
    auto& operations = all[name];
    if (std::find(operations.begin(), operations.end(), operation) == operations.end())
      operations.push_back(operation);
  }
}

// Whether the spindle's limit, which is no row there, makes a sweep over diameters
// slower.
bool clamped(const Chain& chain, const Choice<double>& c, std::size_t i) {
  const auto& o = chain.operations[i];
  if (!o.tapered) return false;
  const double cap = spindle_cap(o, limiting_forces(o, c.f[i], c.a), c.a);
  return c.v[i] >
         units::cutting_speed_m_min(cap, sweep(o, o.narrowest(), c.a).D_small_mm);
}

Binding binding(const PreparedPart& p, const std::vector<SolvedSetup>& setups) {
  Binding all;
  for (const auto& s : setups)
    for (const auto& f : s.features) {
      if (!f.answer.feasible) continue;
      const auto operations = operation_results(p, s.setup, f, {p.machine_per_min});
      const auto& m = *f.answer.model;
      for (std::size_t r = 0; r < m.rows().size(); ++r) {
        const auto& row = m.rows()[r];
        if (!(f.answer.multipliers[r] > kWorthNaming)) continue;
        const bool last = row.check == Check::tolerance;
        add(limit_names(p, f, row),
            (last ? operations.back() : operations[row.operation]).id, all);
      }
      for (std::size_t i = 0; i < operations.size(); ++i)
        if (clamped(m.chain(), f.answer.choice, i))
          add(spindle_limit_names(p, f, i), operations[i].id, all);
    }
  return all;
}

// d objective/d ln(limit) where it is opened.
double slope(const PreparedPart& p, const std::vector<SolvedSetup>& setups,
             const Limit& l) {
  PlanRequest opened = p;
  l.scale(opened, l.at_most ? 1 + kStep : 1 / (1 + kStep));
  return -first_order(p, setups, prepare(std::move(opened), p)).value_or(0) /
         std::log1p(kStep);
}

Price price(const PreparedPart& p, const Limit& l, double gain,
            std::vector<std::string> binds_in) {
  const double then = l.at_most ? l.now * 1.1 : l.now / 1.1;
  const auto sentence = say(
      "{} from {} to {}{}{} saves {:.4f}{} per part{}", l.called, readable(l.now),
      readable(then), l.unit.empty() ? "" : " ", l.unit, gain, unit_of_objective(p),
      p.batch ? say(", {} per batch of {}", readable(gain * *p.batch), readable(*p.batch))
              : "");
  std::optional<double> batch;
  if (p.batch) batch = gain * *p.batch;
  return {l.name, l.now, l.unit, gain, batch, std::move(binds_in), sentence};
}

}  // namespace

std::vector<Price> prices(const PreparedPart& p, const std::vector<SolvedSetup>& setups) {
  double objective = 0;
  for (const auto& s : setups) objective += s.objective;
  const auto holds = binding(p, setups);
  std::vector<Price> all;
  for (const auto& l : limits(p)) {
    const auto where = holds.find(l.name);
    if (where == holds.end()) continue;
    const double gain = slope(p, setups, l) * kTenPercent;
    if (gain > kWorthNaming * objective) all.push_back(price(p, l, gain, where->second));
  }
  std::stable_sort(all.begin(), all.end(), [](const Price& a, const Price& b) {
    return a.saves_per_part_for_10_percent > b.saves_per_part_for_10_percent;
  });
  return all;
}

}  // namespace turnwright::planning
