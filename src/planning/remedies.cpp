#include "remedies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "feasibility.hpp"
#include "planned.hpp"
#include "recipes.hpp"
#include "usable.hpp"

namespace turnwright::planning {
namespace {

using Change = Remedy::Change;

struct Variant {
  PlanRequest plan;
  Remedy remedy;
};

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

void add_clampings(const PreparedPart& p, std::size_t s, const SetupWork& work,
                   std::vector<Variant>& all) {
  const auto& allowed = p.setups[s].clampings;
  const auto add = [&](Clamping c, double steady_mm) {
    Variant v{
        p,
        {.change = Change::clamping, .setup = s, .clamping = c, .steady_mm = steady_mm}};
    v.plan.setups[s].clampings.push_back(c);
    if (c == Clamping::chuck_steady) v.plan.setups[s].steady_z_mm = steady_mm;
    v.remedy.sentence = fmt::format("allowing {} in setup {}", name(c), s);
    if (c == Clamping::chuck_steady)
      v.remedy.sentence += fmt::format(", the rest at z = {} mm", readable(steady_mm));
    all.push_back(std::move(v));
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
      for (const double z : steady_places_mm(p, s, work)) add(c, z);
  }
}

// Jaws as far as the nearest element that the setup cuts, but for the largest corner that
// has to roll over its end.
void add_grip(const PreparedPart& p, std::size_t s, const SetupWork& work,
              std::vector<Variant>& all) {
  constexpr double kDigit_mm = 0.1, kWorth_mm = 1;
  const double root = root_z_mm(p, s, Clamping::chuck), free = free_z_mm(p, s);
  double room = std::abs(free - root);
  for (const std::size_t i : work.elements) {
    const double z0 = part::left_z_mm(p.drawing, i);
    const double z1 = z0 + p.drawing.outer[i].length_mm;
    room = std::min(room, free > root ? z0 - root : root - z1);
  }
  double corner = 0;
  for (const auto& t : p.tools) corner = std::max(corner, t.re_mm);
  room -= corner;
  const double grip = std::floor((p.setups[s].grip_mm + room) / kDigit_mm) * kDigit_mm;
  if (work.elements.empty() || !(grip >= p.setups[s].grip_mm + kWorth_mm)) return;
  Variant v{p, {.change = Change::grip, .setup = s, .grip_mm = grip}};
  v.plan.setups[s].grip_mm = grip;
  v.remedy.sentence = fmt::format("gripping {} instead of {} mm in setup {}",
                                  readable(grip), readable(p.setups[s].grip_mm), s);
  auto& clampings = v.plan.setups[s].clampings;
  if (!rest_stands_free(v.plan, s) && std::erase(clampings, Clamping::chuck_steady)) {
    if (clampings.empty()) return;
    v.remedy.sentence += ", without the steady rest,";
  }
  all.push_back(std::move(v));
}

void add_tools(const PreparedPart& p, std::vector<Variant>& all) {
  for (const auto& tool : p.spare_tools) {
    if (std::find(tool.groups.begin(), tool.groups.end(), p.material.group) ==
        tool.groups.end())
      continue;
    Variant v{p, {.change = Change::tool, .name = tool.id}};
    v.plan.tools.push_back(tool);
    v.remedy.sentence = "the tool " + tool.id;
    all.push_back(std::move(v));
  }
}

void add_operations(const PreparedPart& p, std::vector<Variant>& all) {
  const auto limits = limits_of(p);
  for (std::size_t i = 0; i < limits.size(); ++i) {
    const auto& l = limits[i];
    if (!is_given(l)) continue;
    const char* key = l.kind == Openable::Kind::passes ? "passes"
                      : l.kind == Openable::Kind::ap   ? "ap_mm"
                      : l.kind == Openable::Kind::f    ? "f_mm_rev"
                                                       : "vc_m_min";
    const auto& id = (*p.operations)[l.index].id;
    all.push_back(
        {opened(p, {l}, {kWithout}),
         {.change = Change::operation,
          .name = id,
          .key = key,
          .sentence = fmt::format("leaving {} of {} to the planner", key, id)}});
  }
}

}  // namespace

std::vector<Remedy> remedies(const PreparedPart& p, const Attempt& attempt) {
  std::vector<Variant> variants;
  for (std::size_t s = 0; s < p.setups.size(); ++s) {
    const auto& setup = attempt.setups[s];
    if (setup.solved && setup.chosen.feasible()) continue;
    add_clampings(p, s, p.work.setups[s], variants);
    add_grip(p, s, p.work.setups[s], variants);
  }
  add_tools(p, variants);
  add_operations(p, variants);
  std::vector<Remedy> all;
  for (auto& [plan, remedy] : variants) {
    const auto changed = prepare(std::move(plan));
    Feasibility part(changed);
    if (!part.with(Openings(part.limits().size(), 1))) continue;
    const auto planned_with = conforming(changed, {}, Why::untold);
    if (planned_with.status != PlanStatus::ok) continue;
    remedy.cost_per_part = planned_with.cost_per_part;
    remedy.time_per_part_min = planned_with.time_per_part_min;
    remedy.sentence +=
        fmt::format(" makes it possible, at {} per part", readable(remedy.cost_per_part));
    all.push_back(std::move(remedy));
  }
  std::stable_sort(all.begin(), all.end(), [](const Remedy& a, const Remedy& b) {
    return a.cost_per_part < b.cost_per_part;
  });
  return all;
}

}  // namespace turnwright::planning
