#include "outcome.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "milled.hpp"
#include "setup_planner.hpp"
#include "turnwright/planning/machine_share.hpp"
#include "window.hpp"

namespace turnwright::planning {

bool SolvedSetup::feasible() const {
  return std::all_of(features.begin(), features.end(),
                     [](const SolvedFeature& f) { return f.answer.feasible; });
}

namespace {

constexpr std::array kShares{&Breakdown::cutting,      &Breakdown::air,
                             &Breakdown::tool_changes, &Breakdown::operator_stops,
                             &Breakdown::edges,        &Breakdown::loading,
                             &Breakdown::setup_share};

}  // namespace

Breakdown& Breakdown::operator+=(const Breakdown& other) {
  for (const auto share : kShares) {
    (this->*share).time_min += (other.*share).time_min;
    (this->*share).cost += (other.*share).cost;
  }
  return *this;
}

Spending Breakdown::total() const {
  Spending sum;
  for (const auto share : kShares) {
    sum.time_min += (this->*share).time_min;
    sum.cost += (this->*share).cost;
  }
  return sum;
}

Breakdown breakdown(const PreparedPart& p, const SolvedSetup& s) {
  auto b = besides_cutting(p, s.clamping, s.between);
  for (const auto& f : s.features) {
    if (!f.answer.feasible) continue;
    const auto u = spent(f.answer);
    b.cutting.time_min += u.cut_min;
    b.air.time_min += u.air_min;
    b.edges.time_min += u.change_min;
    b.edges.cost += u.edges_cost;
  }
  for (const auto& o : s.fixed.all()) {
    b.cutting.time_min += o.plan.time_min;
    b.air.time_min += o.air_min;
    b.edges.time_min += o.change_min;
    b.edges.cost += o.edges_cost;
  }
  for (const auto share : kShares)
    (b.*share).cost += p.machine_per_min * (b.*share).time_min;
  return b;
}

void add_totals(const PreparedPart& p, ProcessPlan& result) {
  const auto total = result.breakdown.total();
  result.cost_per_part = total.cost;
  result.time_per_part_min = total.time_min;
  if (p.price) result.profit_per_min = (*p.price - total.cost) / total.time_min;
}

SettingUp setting_up(const PlanRequest& p) {
  SettingUp all;
  all.minutes = static_cast<double>(p.setups.size()) * p.machine.setup_min;
  all.cost = p.machine_per_min * all.minutes;
  if (!p.batch) return all;
  all.minutes_per_part = all.minutes / *p.batch;
  all.cost_per_part = all.cost / *p.batch;
  return all;
}

std::optional<WorstConformance> worst_conformance(
    const PlanRequest& p, const std::vector<ToleranceResult>& all) {
  const auto worst = std::ranges::min_element(all, {}, &ToleranceResult::P_conform);
  if (worst == all.end()) return {};
  return WorstConformance{worst->id, worst->P_conform, p.conformance};
}

std::vector<OperationPlan> operations_in_order(const PreparedPart& p,
                                               const SolvedSetup& s) {
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
  std::vector<OperationPlan> all = std::move(places[0]);
  for (const auto& o : s.fixed.before) all.push_back(o.plan);
  for (std::size_t i = 1; i < places.size(); ++i)
    all.insert(all.end(), std::make_move_iterator(places[i].begin()),
               std::make_move_iterator(places[i].end()));
  for (const auto& o : s.fixed.after) all.push_back(o.plan);
  for (auto& o : all) add_lobes(p, o);
  return all;
}

void add_unreachable(const PreparedPart& p, ProcessPlan& result) {
  for (const auto& sentence : p.work.unreachable)
    result.conflicts.push_back({"setups", "all setups", 0, 0, "", sentence});
}

void add_used_up(const PreparedPart& p, const std::vector<std::size_t>& tolerances,
                 ProcessPlan& result) {
  constexpr double kBeyond = 1.001;
  for (const std::size_t i : tolerances) {
    const auto& t = p.drawing.tolerances[i];
    const double width = width_mm(t), share_mm = least_machine_mm(p, i);
    if (width > share_mm) continue;
    const auto called = t.id + " " + part::name(t.kind);
    const auto of = t.of.empty() ? t.between[0] + " .. " + t.between[1] : t.of;
    result.conflicts.push_back(
        {called, of, share_mm, width, "mm",
         fmt::format("{} of {}: the machine's share of {} mm leaves nothing of {} mm",
                     called, of, readable(share_mm), readable(width))});
    result.relax.push_back(
        {called + " of " + of, width, share_mm * kBeyond, "mm",
         fmt::format("{} would have to open beyond the machine's share, {} mm, or the "
                     "machine's share be less",
                     called, readable(share_mm))});
  }
}

void add_fixed_obstacles(const PreparedPart& p, ProcessPlan& result) {
  for (std::size_t s = 0; s < p.setups.size(); ++s) {
    std::vector<std::pair<Clamping, Conflict>> all;
    const auto& clampings = p.setups[s].clampings;
    const bool stuck = std::ranges::all_of(clampings, [&](Clamping c) {
      const auto conflicts = fixed_conflicts(p, s, c, p.work.setups[s]);
      for (const auto& one : conflicts) all.emplace_back(c, one);
      return !conflicts.empty();
    });
    if (!stuck) continue;
    std::map<std::string, std::size_t> times;
    for (const auto& [c, one] : all) ++times[one.sentence];
    for (auto& [c, one] : all) {
      const auto count = times[one.sentence];
      if (count == 0) continue;  // told
      times[one.sentence] = 0;
      if (count < clampings.size())
        one.sentence = fmt::format("{}: {}", name(c), one.sentence);
      result.conflicts.push_back(std::move(one));
    }
  }
}

std::vector<std::size_t> tolerances_left_to_the_stock(const PreparedPart& p) {
  std::set<std::string> made;
  for (std::size_t s = 0; s < p.work.setups.size(); ++s) {
    const auto& w = p.work.setups[s];
    for (const std::size_t i : w.elements) made.insert(p.drawing.outer[i].id);
    for (const std::size_t i : w.bores) made.insert(p.drawing.inner[i].id);
    for (const std::size_t k : w.shoulders) made.insert(shoulder_id(p.drawing, k));
    if (w.end_face) made.insert(free_face(p, s));
  }
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < p.drawing.tolerances.size(); ++i) {
    const auto& t = p.drawing.tolerances[i];
    if (!made.count(t.of) && !made.count(t.between[0]) && !made.count(t.between[1]))
      left.push_back(i);
  }
  return left;
}

}  // namespace turnwright::planning
