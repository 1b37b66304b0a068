#include "turnwright/planning/rules.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/say.hpp"
#include "planning/values/readable.hpp"

namespace turnwright::planning {
namespace {

using catalogue::HouseSpeed;
using catalogue::ProvenConditions;
using catalogue::Range;
using catalogue::Tool;

bool holds(const std::vector<std::string>& ids, const std::string& id) {
  return std::ranges::find(ids, id) != ids.end();
}

Range common(const Range& a, const Range& b) {
  return {std::max(a.lower, b.lower), std::min(a.upper, b.upper)};
}

bool empty(const Range& r) { return !(r.lower <= r.upper); }

void forbid(const std::vector<std::string>& ids, PlanRequest& r) {
  const auto forbidden = [&](const auto& tool) { return holds(ids, tool.id); };
  std::erase_if(r.tools, forbidden);
  std::erase_if(r.fixed_tools, forbidden);
  std::erase_if(r.spare_tools, forbidden);
}

bool concerns(const HouseSpeed& s, const std::string& tool, const PlanRequest& r) {
  return s.tool.value_or(tool) == tool &&
         s.material.value_or(r.material.id) == r.material.id &&
         s.group.value_or(r.material.group) == r.material.group;
}

// No faster than allowed, and as slow as the tool's window goes.
catalogue::FixedConditions slowed(const catalogue::FixedConditions& c,
                                  const Range& allowed) {
  auto other = catalogue::at(c, std::min(c.vc_m_min, allowed.upper), c.f_mm_rev);
  if (!other.window) return other;
  auto& [lowest, highest] = other.window->vc_m_min;
  highest = std::min(highest, allowed.upper);
  lowest = std::min(std::max(lowest, allowed.lower), highest);
  return other;
}

void keep(const HouseSpeed& s, PlanRequest& r) {
  for (auto* tools : {&r.tools, &r.spare_tools})
    for (auto& t : *tools)
      if (concerns(s, t.id, r)) t.vc_m_min = common(t.vc_m_min, s.vc_m_min);
  for (auto& t : r.fixed_tools) {
    if (!concerns(s, t.id, r)) continue;
    for (auto& c : t.conditions) c = slowed(c, s.vc_m_min);
  }
}

void keep_spindle(double n_max_rpm, PlanRequest& r) {
  r.machine.n_max_rpm = std::min(r.machine.n_max_rpm, n_max_rpm);
  if (auto& driven = r.machine.driven_tools)
    driven->n_max_rpm = std::min(driven->n_max_rpm, n_max_rpm);
}

const ProvenConditions* proven_for(const Tool& t, const PlanRequest& r) {
  for (const auto& p : r.rules.proven)
    if (p.tool == t.id && p.material == r.material.id) return &p;
  return nullptr;
}

// The uses for which some tool has proven conditions, served by these tools alone.
void prefer_proven(PlanRequest& r) {
  if (!prefers_proven(r)) return;
  std::vector<catalogue::ToolUse> served;
  for (auto& t : r.tools) {
    const auto* p = proven_for(t, r);
    if (!p) continue;
    served.insert(served.end(), t.uses.begin(), t.uses.end());
    if (p->vc_m_min) t.vc_m_min = common(t.vc_m_min, *p->vc_m_min);
    if (p->f_mm_rev) t.f_mm_rev = common(t.f_mm_rev, *p->f_mm_rev);
    if (p->ap_mm) t.ap_mm = common(t.ap_mm, *p->ap_mm);
  }
  for (auto& t : r.tools)
    if (!proven_for(t, r))
      std::erase_if(t.uses, [&](auto use) {
        return std::ranges::find(served, use) != served.end();
      });
}

std::string range_words(const Range& r) {
  return say("{} to {} m/min", readable(r.lower), readable(r.upper));
}

std::string words(const HouseSpeed& s) {
  auto text = say("speeds are {}", range_words(s.vc_m_min));
  if (s.tool) text += say(" with {}", *s.tool);
  if (s.material) text += say(" in {}", *s.material);
  if (s.group) text += say(" in group {}", "PMKNSH"[static_cast<std::size_t>(*s.group)]);
  return text;
}

bool changes(const HouseSpeed& s, const PlanRequest& r) {
  const auto cut = [&](const Tool& t) {
    return concerns(s, t.id, r) &&
           (t.vc_m_min.lower < s.vc_m_min.lower || t.vc_m_min.upper > s.vc_m_min.upper);
  };
  const auto limited = [&](const catalogue::FixedTool& t) {
    const auto* c = t.conditions_in(r.material.group);
    if (!c || !concerns(s, t.id, r)) return false;
    const Range own = c->window ? c->window->vc_m_min : Range{0, c->vc_m_min};
    return own.upper > s.vc_m_min.upper || (c->window && own.lower < s.vc_m_min.lower);
  };
  return std::ranges::any_of(r.tools, cut) || std::ranges::any_of(r.fixed_tools, limited);
}

bool changes_spindle(const PlanRequest& r) {
  const auto slower = [&](double n_max_rpm) { return n_max_rpm > *r.rules.n_max_rpm; };
  const auto& driven = r.machine.driven_tools;
  return r.rules.n_max_rpm &&
         (slower(r.machine.n_max_rpm) || (driven && slower(driven->n_max_rpm)));
}

}  // namespace

bool prefers_proven(const PlanRequest& r) {
  return !r.operations &&
         std::ranges::any_of(r.tools, [&](const Tool& t) { return proven_for(t, r); });
}

PlanRequest ruled(PlanRequest r) {
  forbid(r.rules.forbidden_tools, r);
  for (const auto& s : r.rules.speeds) keep(s, r);
  if (r.rules.n_max_rpm) keep_spindle(*r.rules.n_max_rpm, r);
  prefer_proven(r);
  std::erase_if(r.tools, [](const Tool& t) {
    return t.uses.empty() || empty(t.vc_m_min) || empty(t.f_mm_rev) || empty(t.ap_mm);
  });
  return r;
}

std::vector<WithoutRule> without_each_rule(const PlanRequest& request) {
  std::vector<WithoutRule> all;
  const auto drop = [&](const std::string& rule) -> catalogue::ShopRules& {
    all.push_back({say("without the rule that {}", rule), request});
    return all.back().request.rules;
  };
  const auto& rules = request.rules;
  for (const auto& id : rules.forbidden_tools) {
    const auto is = [&](const auto& tool) { return tool.id == id; };
    if (std::ranges::any_of(request.tools, is) ||
        std::ranges::any_of(request.fixed_tools, is))
      std::erase(drop(say("{} is forbidden", id)).forbidden_tools, id);
  }
  for (std::size_t i = 0; i < rules.speeds.size(); ++i)
    if (changes(rules.speeds[i], request)) {
      auto& speeds = drop(words(rules.speeds[i])).speeds;
      speeds.erase(speeds.begin() + static_cast<std::ptrdiff_t>(i));
    }
  if (changes_spindle(request))
    drop(say("no spindle runs faster than {} rpm", readable(*rules.n_max_rpm)))
        .n_max_rpm.reset();
  if (prefers_proven(request)) drop(tr("proven conditions are preferred")).proven.clear();
  return all;
}

}  // namespace turnwright::planning
