#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outcome.hpp"

namespace turnwright::planning {
namespace {

constexpr double kWorthNaming = 1e-7;  // of the objective: below it a price is rounding
const double kTenPercent = std::log(1.1);

// What 10 % on the drawing's own width does to what is left of it for the cut.
double leverage(const part::Tolerance& t, const Demand& d) {
  return width_mm(t) / (width_mm(t) - d.taken_mm);
}

const char* unit_of_objective(const PartPlan& p) {
  return p.objective == Objective::time ? " min" : "";
}

void add(const PartPlan& p, const SolvedFeature& f, const OperationPlan& o,
         const ConstraintValue& c, std::vector<Price>& all) {
  if (!(c.shadow_price > kWorthNaming)) return;
  double gain = c.shadow_price * f.answer.objective * kTenPercent;
  Price price;
  price.limit = o.id + ": " + c.name;
  price.now = c.limit;
  price.unit = c.unit;
  for (const auto& d : f.task.demands) {  // of the width that the drawing gives
    const auto& t = p.drawing.tolerances[d.tolerance];
    if (c.name != t.id + " " + part::name(t.kind)) continue;
    gain *= leverage(t, d);
    price.now = width_mm(t);
  }
  price.saves_per_part_for_10_percent = gain;
  const double then = c.at_most ? price.now * 1.1 : price.now / 1.1;
  price.sentence =
      fmt::format("{} {} of {} from {} to {} {} saves {:.4f}{} per part",
                  c.at_most ? "raising" : "lowering", c.name, o.id, readable(price.now),
                  readable(then), c.unit, gain, unit_of_objective(p));
  all.push_back(std::move(price));
}

}  // namespace

std::string readable(double value) {
  return std::abs(value) < 1e4 ? fmt::format("{:.4g}", value)
                               : fmt::format("{:.0f}", value);
}

std::vector<Price> prices(const PartPlan& p, const std::vector<SolvedSetup>& setups) {
  std::vector<Price> all;
  for (const auto& s : setups)
    for (const auto& f : s.features)
      if (f.answer.feasible)
        for (const auto& o : describe(p, s.setup, f, {p.machine_per_min}))
          for (const auto& c : o.constraints) add(p, f, o, c, all);
  std::stable_sort(all.begin(), all.end(), [](const Price& a, const Price& b) {
    return a.saves_per_part_for_10_percent > b.saves_per_part_for_10_percent;
  });
  return all;
}

}  // namespace turnwright::planning
