#include "feasibility.hpp"

#include <algorithm>
#include <functional>

#include "planning/clamping/clamping_checks.hpp"
#include "planning/setup/setup_planner.hpp"
#include "turnwright/planning/prepare.hpp"

namespace turnwright::planning {
namespace {

// What it costs plays no part.
constexpr Economy kAnyEconomy{1, 1};

const char* const kNoTool = "";

// Recipes that may be tried name all tools of a task, but those with none of one kind.
std::pair<std::string, std::string> tools_of(const SurfaceTask& t) {
  std::pair<std::string, std::string> ids{kNoTool, kNoTool};
  for (const auto& r : t.recipes) {
    if (r.rough) ids.first = r.rough->id;
    if (r.finish) ids.second = r.finish->id;
  }
  return ids;
}

// Whether limits are relaxed as far as others, or further.
bool as_relaxed(const std::vector<double>& these, const std::vector<double>& others) {
  return std::ranges::equal(these, others, std::greater_equal<>{});
}

}  // namespace

Feasibility::Feasibility(const PreparedPart& part)
    : part_(part), limits_(relaxable_limits(part)) {}

std::vector<double> Feasibility::state(const RelaxationFactors& factors,
                                       const std::string& surface) const {
  std::vector<double> of_surface;
  for (std::size_t i = 0; i < limits_.size(); ++i)
    if (bears_on(part_, limits_[i], surface)) of_surface.push_back(factors[i]);
  return of_surface;
}

bool Feasibility::made(const PreparedPart& p, const SurfaceTask& task,
                       const RelaxationFactors& factors, const Found& found) {
  const auto& surface = task.feature.surface();
  if (left_out_.count(surface)) return true;
  const auto [rough, finish] = tools_of(task);
  const auto [setup, clamping, last] = task.making;
  auto& tried =
      tried_[{setup, clamping, jaw_force_N(p, setup, clamping, Stage::finishing), surface,
              rough, finish}];
  const auto asked = state(factors, surface);
  for (const auto& t : tried)
    if (!(t.made && found) &&
        (t.made ? as_relaxed(asked, t.factors) : as_relaxed(t.factors, asked)))
      return t.made;
  const auto answer = any_answer(task);
  if (answer.feasible && found) found(task, answer);
  tried.push_back({asked, answer.feasible});
  return answer.feasible;
}

bool Feasibility::setup_made(const PreparedPart& p, std::size_t s, const SetupWork& work,
                             const Finished& done, const RelaxationFactors& factors,
                             const Found& found) {
  bool any_clamping = false;
  for (const Clamping c : p.setups[s].clampings) {
    if (!unusable(p, s, c, work, done).empty()) continue;
    any_clamping = true;
    SharedMemory shared;
    SetupPlanner planner(p, s, c, work, done, kAnyEconomy, shared);
    planner.allow_compensation();
    std::set<std::string> tried, succeeded;
    const bool all = planner.can_be_made([&](const SurfaceTask& t) {
      const bool can = made(p, t, factors, found);
      (can ? succeeded : tried).insert(t.feature.surface());
      return can;
    });
    if (all) return true;
    for (const auto& surface : tried)
      if (!succeeded.count(surface)) failed_.insert(surface);
  }
  return !any_clamping;  // no limit decides that
}

bool Feasibility::with(const RelaxationFactors& factors, const Found& found) {
  const auto p = prepare(relaxed(part_, limits_, factors), part_);
  auto done = nothing_finished(p.drawing);
  bool all = true;
  failed_.clear();
  for (std::size_t s = 0; s < p.setups.size(); ++s) {
    all = setup_made(p, s, p.work.setups[s], done, factors, found) && all;
    finish(done, p.work.setups[s]);
  }
  return all;
}

}  // namespace turnwright::planning
