#include "remedies.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "base/say.hpp"
#include "certified_plan.hpp"
#include "planning/clamping/positions.hpp"
#include "planning/explain/feasibility.hpp"
#include "planning/limits/relaxation.hpp"
#include "planning/preparation/grips.hpp"
#include "planning/values/readable.hpp"
#include "planning/values/side_by_side.hpp"
#include "turnwright/planning/prepare.hpp"

namespace turnwright::planning {
namespace {

using Kind = RequestChange::Kind;

struct Variant {
  RequestChange change;
  std::string sentence;
};

PlanRequest with(PlanRequest r, const RequestChange& c) {
  switch (c.kind) {
    case Kind::clamping:
      r.setups[c.setup].clampings.push_back(c.clamping);
      if (c.clamping == Clamping::chuck_steady)
        r.setups[c.setup].steady_z_mm = c.steady_mm;
      break;
    case Kind::grip:
      r.setups[c.setup].grip_mm = c.grip_mm;
      break;
    case Kind::tool:
      r.tools.push_back(*std::ranges::find(r.spare_tools, c.name, &catalogue::Tool::id));
      break;
    case Kind::operation: {
      auto& given =
          std::ranges::find(*r.operations, c.name, &OperationRequest::id)->conditions;
      if (c.key == "passes") given.passes.reset();
      if (c.key == "ap_mm") given.ap_mm.reset();
      if (c.key == "f_mm_rev") given.f_mm_rev.reset();
      if (c.key == "vc_m_min") given.vc_m_min.reset();
      break;
    }
  }
  return r;
}

bool is_cut(const std::vector<std::size_t>& elements, std::size_t i) {
  return std::find(elements.begin(), elements.end(), i) != elements.end();
}

// The middles of outer elements between jaws and free end that a setup does not cut.
std::vector<double> steady_places_mm(const PreparedPart& p, std::size_t s,
                                     const SetupWork& work) {
  std::vector<double> places;
  const double root = root_z_mm(p, s, Clamping::chuck_steady), free = free_z_mm(p, s);
  for (std::size_t i = 0; i < p.drawing.outer.size(); ++i) {
    const double z0 = part::left_z_mm(p.drawing, i);
    const double z1 = z0 + p.drawing.outer[i].length_mm;
    const double low = std::max(z0, std::min(root, free));
    const double high = std::min(z1, std::max(root, free));
    if (!is_cut(work.elements, i) && high - low >= kSteadyWidth_mm)
      places.push_back((low + high) / 2);
  }
  return places;
}

void add_clampings(const PreparedPart& p, std::size_t s, std::vector<Variant>& all) {
  const auto& allowed = p.setups[s].clampings;
  const auto add = [&](Clamping c, double steady_mm) {
    auto sentence = say("allowing {} in {}", tr(name(c)), setup_label(s));
    if (c == Clamping::chuck_steady)
      sentence += say(", the rest at z = {} mm", readable(steady_mm));
    all.push_back(
        {{.kind = Kind::clamping, .setup = s, .clamping = c, .steady_mm = steady_mm},
         std::move(sentence)});
  };
  for (const Clamping c :
       {Clamping::chuck, Clamping::chuck_tailstock, Clamping::between_centres,
        Clamping::chuck_steady, Clamping::tailstock_follow}) {
    if (!p.machine.has(name(c)) ||
        std::find(allowed.begin(), allowed.end(), c) != allowed.end())
      continue;
    if (c != Clamping::chuck_steady)
      add(c, 0);
    else
      for (const double z : steady_places_mm(p, s, p.work.setups[s])) add(c, z);
  }
}

void add_grip(const PreparedPart& p, std::size_t s, double grip_mm,
              std::vector<Variant>& all) {
  all.push_back({{.kind = Kind::grip, .setup = s, .grip_mm = grip_mm},
                 say("gripping {} instead of {} mm in {}", readable(grip_mm),
                     readable(p.grips_mm[s]), setup_label(s))});
}

void add_tools(const PreparedPart& p, std::vector<Variant>& all) {
  for (const auto& tool : p.spare_tools)
    if (std::find(tool.groups.begin(), tool.groups.end(), p.material.group) !=
        tool.groups.end())
      all.push_back({{.kind = Kind::tool, .name = tool.id}, say("the tool {}", tool.id)});
}

void add_operations(const PreparedPart& p, std::vector<Variant>& all) {
  for (const auto& l : relaxable_limits(p)) {
    if (!l.row->given()) continue;
    const char* key = l.row->name;
    const auto& id = (*p.operations)[l.owner].id;
    all.push_back({{.kind = Kind::operation, .name = id, .key = key},
                   say("leaving {} of {} to the planner", key, id)});
  }
}

std::vector<Variant> variants(const PreparedPart& p, const Attempt* attempt) {
  std::vector<Variant> all;
  for (std::size_t s = 0; s < p.setups.size(); ++s) {
    const auto* setup = attempt ? &attempt->setups[s] : nullptr;
    if (setup && setup->solved && setup->chosen.feasible()) continue;
    add_clampings(p, s, all);
    if (const auto grip = longer_grip_mm(p, s)) add_grip(p, s, *grip, all);
    if (!p.work.unreachable.empty())
      for (const double grip : shorter_grips_mm(p, s)) add_grip(p, s, grip, all);
  }
  add_tools(p, all);
  add_operations(p, all);
  return all;
}

std::optional<ProcessPlan> plan_of(const PreparedPart& changed) {
  if (Feasibility oracle(changed);
      !oracle.with(RelaxationFactors(oracle.limits().size(), 1)))
    return {};
  auto plan = certified_plan(changed);
  if (plan.status != PlanStatus::ok) return {};
  return plan;
}

// The plan of a changed request, if there is one.
std::optional<ProcessPlan> plan_of(PlanRequest request) {
  if (!not_made(request).empty()) return {};
  const auto changed = prepare(std::move(request));
  auto plan = plan_of(changed);
  const auto other = faced_otherwise(changed);
  auto otherwise = other ? plan_of(*other) : std::nullopt;
  if (otherwise && (!plan || is_better(changed, *otherwise, *plan))) return otherwise;
  return plan;
}

using Plans = std::vector<std::optional<ProcessPlan>>;

// The plans of that many changed requests.
Plans plans_of(std::size_t count,
               const std::function<PlanRequest(std::size_t)>& request) {
  Plans all(count);
  side_by_side(count, [&](std::size_t i) { all[i] = plan_of(request(i)); });
  return all;
}

void add_remedy(const ProcessPlan& with, std::vector<RequestChange> changes,
                const std::string& sentence, std::vector<Remedy>& all) {
  const bool two = changes.size() > 1;
  const auto cost = readable(with.cost_per_part);
  all.push_back({std::move(changes),
                 two ? say("{} make it possible, at {} per part", sentence, cost)
                     : say("{} makes it possible, at {} per part", sentence, cost),
                 with.cost_per_part, with.time_per_part_min});
}

// Two changes together; those of one setup's jaws, or of two tools, exclude each other.
void add_pairs(const PreparedPart& p, const std::vector<Variant>& all,
               std::vector<Remedy>& found) {
  constexpr std::size_t kTried = 100;
  std::vector<std::pair<const Variant*, const Variant*>> pairs;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t k = i + 1; k < all.size() && pairs.size() < kTried; ++k) {
      const auto &a = all[i].change, &b = all[k].change;
      if (a.kind == b.kind && (a.kind == Kind::tool || a.setup == b.setup)) continue;
      pairs.emplace_back(&all[i], &all[k]);
    }
  const auto plans = plans_of(pairs.size(), [&](std::size_t i) {
    return with(with(p, pairs[i].first->change), pairs[i].second->change);
  });
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto& [a, b] = pairs[i];
    if (plans[i])
      add_remedy(*plans[i], {a->change, b->change},
                 say("{} and {}", a->sentence, b->sentence), found);
  }
}

}  // namespace

void add_remedies(const PreparedPart& p, const Attempt* attempt, ProcessPlan& result) {
  const auto all = variants(p, attempt);
  const auto plans =
      plans_of(all.size(), [&](std::size_t i) { return with(p, all[i].change); });
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& [change, sentence] = all[i];
    if (plans[i])
      add_remedy(*plans[i], {change}, sentence, result.remedies);
    else
      result.tried.push_back({change, sentence});
  }
  if (result.remedies.empty() && result.relax.empty()) add_pairs(p, all, result.remedies);
  std::stable_sort(
      result.remedies.begin(), result.remedies.end(),
      [](const Remedy& a, const Remedy& b) { return a.cost_per_part < b.cost_per_part; });
}

}  // namespace turnwright::planning
