#include "outcome.hpp"

#include <fmt/format.h>

#include "setup_planner.hpp"
#include "turnwright/base/units.hpp"
#include "window.hpp"

namespace turnwright::planning {

bool SolvedSetup::feasible() const {
  return std::all_of(features.begin(), features.end(),
                     [](const SolvedFeature& f) { return f.answer.feasible; });
}

Totals totals(const PartPlan& p, const SolvedSetup& s) {
  Totals t;
  t.minutes = minutes_besides_cutting(p, s.clamping, s.indexings);
  for (const auto& f : s.features) {
    if (!f.answer.feasible) continue;
    const auto u = spent(f.answer);
    t.minutes += u.minutes + u.change_min;
    t.cost += u.edges_cost;
  }
  t.cost += p.machine_per_min * t.minutes;
  return t;
}

std::vector<OperationPlan> operations_in_order(const PartPlan& p, const SolvedSetup& s) {
  std::vector<std::vector<OperationPlan>> places(kPlaces);
  for (const auto& f : s.features) {
    if (!f.answer.model) continue;
    auto operations = describe(p, s.setup, f, {p.machine_per_min});
    for (std::size_t i = 0; i < operations.size(); ++i) {
      auto& o = operations[i];
      if (f.answer.feasible) o.window = operating_window(p, f, i);
      const bool rough =
          o.kind == OperationKind::rough || o.kind == OperationKind::bore_rough;
      places[place_in_setup(f.task.feature.kind(), rough)].push_back(std::move(o));
    }
  }
  std::vector<OperationPlan> all;
  for (auto& place : places)
    all.insert(all.end(), std::make_move_iterator(place.begin()),
               std::make_move_iterator(place.end()));
  return all;
}

void add_obstacles(const PartPlan& p, const Assignment& work, ProcessPlan& result) {
  for (const auto& sentence : work.unreachable)
    result.conflicts.push_back({"setups", "all setups", 0, 0, "", sentence});
  const double share_mm = units::mm_from_um(p.machine_share_um);
  for (const auto& t : p.drawing.tolerances) {
    const double width = width_mm(t);
    if (width > share_mm) continue;
    const auto called = t.id + " " + part::name(t.kind);
    const auto of = t.of.empty() ? t.between[0] + " .. " + t.between[1] : t.of;
    result.conflicts.push_back(
        {called, of, share_mm, width, "mm",
         fmt::format("{} of {}: the machine's share of {} mm leaves nothing of {} mm",
                     called, of, readable(share_mm), readable(width))});
    result.relax.push_back(
        {called + " of " + of, width, share_mm, "mm",
         fmt::format("{} would have to open beyond the machine's share, {} mm, or the "
                     "machine's share be less",
                     called, readable(share_mm))});
  }
}

}  // namespace turnwright::planning
