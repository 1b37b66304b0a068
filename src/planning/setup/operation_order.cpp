#include "operation_order.hpp"

#include <iterator>

#include "planning/auxiliary/milled_operations.hpp"
#include "planning/surface/operating_window.hpp"

namespace turnwright::planning {

std::size_t place_in_setup(MachinedSurface::Kind kind, bool rough) {
  using enum MachinedSurface::Kind;
  if (kind == end_face) return 0;
  if (kind == element) return rough ? 1 : 2;
  if (kind == shoulder) return 3;
  if (kind == bore) return rough ? 4 : 5;
  return 6;
}

std::vector<OperationPlan> operations_in_order(const PreparedPart& p,
                                               const SolvedSetup& s) {
  std::vector<std::vector<OperationPlan>> places(kPlaces);
  for (const auto& f : s.features) {
    if (!f.answer.model) continue;
    auto operations = operation_results(p, s.setup, f, {p.machine_per_min});
    for (std::size_t i = 0; i < operations.size(); ++i) {
      auto& o = operations[i];
      if (f.answer.feasible) o.window = operating_window(p, f, i);
      const bool rough =
          o.kind == OperationKind::rough || o.kind == OperationKind::bore_rough;
      places[place_in_setup(f.task.feature.kind(), rough)].push_back(std::move(o));
    }
  }
  std::vector<OperationPlan> all = std::move(places[0]);
  for (const auto& o : s.auxiliary.before) all.push_back(o.plan);
  for (std::size_t i = 1; i < places.size(); ++i)
    all.insert(all.end(), std::make_move_iterator(places[i].begin()),
               std::make_move_iterator(places[i].end()));
  for (const auto& o : s.auxiliary.after) all.push_back(o.plan);
  for (auto& o : all) add_lobes(p, o);
  return all;
}

}  // namespace turnwright::planning
