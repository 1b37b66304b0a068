#include "stock_conflicts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "base/say.hpp"
#include "planning/auxiliary/catalogue_operations.hpp"
#include "planning/budget/machine_share.hpp"
#include "planning/budget/tolerance_allocation.hpp"
#include "planning/clamping/clamping_checks.hpp"
#include "planning/clamping/made_surfaces.hpp"
#include "planning/clamping/positions.hpp"
#include "planning/setup/setup_planner.hpp"
#include "planning/values/readable.hpp"
#include "stations.hpp"
#include "turnwright/planning/limit_words.hpp"

namespace turnwright::planning {
namespace {

// In a clamping that cannot be used, those of what is not turned alone.
std::vector<Conflict> conflicts_in(const PreparedPart& p, std::size_t setup, Clamping c,
                                   const Finished& done) {
  const auto& work = p.work.setups[setup];
  if (!unusable(p, setup, c, work, done).empty())
    return auxiliary_conflicts(p, setup, c, work);
  SharedMemory shared;
  return SetupPlanner(p, setup, c, work, done, {p.machine_per_min, 1}, shared)
      .conflicts();
}

}  // namespace

void add_unreachable(const PreparedPart& p, ProcessPlan& result) {
  for (const auto& sentence : p.work.unreachable)
    result.conflicts.push_back(
        {to_translate("setups"), tr("all setups"), 0, 0, "", sentence});
}

void add_used_up(const PreparedPart& p, const std::vector<std::size_t>& tolerances,
                 ProcessPlan& result) {
  constexpr double kBeyond = 1.001;
  for (const std::size_t i : tolerances) {
    const auto& t = p.drawing.tolerances[i];
    const double width = width_mm(t), share_mm = least_machine_mm(p, i);
    if (width > share_mm) continue;
    const auto called = t.id + " " + part::name(t.kind);
    const auto [taken, whole] = readable_apart(share_mm, width);
    const auto of = t.of.empty() ? t.between[0] + " .. " + t.between[1] : t.of;
    result.conflicts.push_back(
        {called, of, share_mm, width, "mm",
         say("{} of {}: the machine's share of {} mm leaves nothing of {} mm",
             limit_words(called), of, taken, whole)});
    result.relax.push_back(
        {called + " of " + of, width, share_mm * kBeyond, "mm",
         say("{} must be wider than the machine's share, {} mm, or that share must be "
             "reduced",
             limit_words(called), readable(share_mm))});
  }
}

void add_auxiliary_conflicts(const PreparedPart& p, ProcessPlan& result) {
  auto done = nothing_finished(p.drawing);
  for (std::size_t s = 0; s < p.setups.size(); ++s) {
    std::vector<std::pair<Clamping, Conflict>> all;
    const auto& clampings = p.setups[s].clampings;
    const bool stuck = std::ranges::all_of(clampings, [&](Clamping c) {
      const auto conflicts = conflicts_in(p, s, c, done);
      for (const auto& one : conflicts) all.emplace_back(c, one);
      return !conflicts.empty();
    });
    finish(done, p.work.setups[s]);
    if (!stuck) continue;
    std::map<std::string, std::size_t> times;
    for (const auto& [c, one] : all) ++times[one.sentence];
    for (auto& [c, one] : all) {
      const auto count = times[one.sentence];
      if (count == 0) continue;  // told
      times[one.sentence] = 0;
      if (count < clampings.size())
        one.sentence = fmt::format("{}: {}", tr(name(c)), one.sentence);
      result.conflicts.push_back(std::move(one));
    }
  }
  if (std::ranges::count(result.conflicts, kStations, &Conflict::limit) > 0)
    add_stations_needed(p, result);
}

std::vector<std::size_t> tolerances_left_to_the_stock(const PreparedPart& p) {
  std::set<std::string> made;
  for (std::size_t s = 0; s < p.work.setups.size(); ++s) {
    const auto& w = p.work.setups[s];
    for (const std::size_t i : w.elements) made.insert(p.drawing.outer[i].id);
    for (const std::size_t i : w.bores) made.insert(p.drawing.inner[i].id);
    for (const std::size_t k : w.shoulders) made.insert(shoulder_id(p.drawing, k));
    for (const std::size_t i : w.inner_shoulders)
      made.insert(part::shoulder_behind(p.drawing, i)->id);
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
