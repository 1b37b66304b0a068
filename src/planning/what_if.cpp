#include "what_if.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/say.hpp"
#include "certified_plan.hpp"
#include "explanation.hpp"
#include "planning/values/readable.hpp"
#include "planning/values/side_by_side.hpp"
#include "turnwright/planning/prepare.hpp"

namespace turnwright::planning {
namespace {

constexpr double kSecondsPerMinute = 60;
constexpr double kCertificates = 2e-4;  // what two gaps may hide of a saving

std::string saves(double amount, const std::string& unit) {
  const auto value = readable(std::abs(amount)) + unit;
  return amount < 0 ? say("costs {}", value) : say("saves {}", value);
}

std::string sentence(const PreparedPart& p, const ProcessPlan& own, const WhatIfAnswer& a,
                     const ProcessPlan& changed) {
  if (!a.feasible) {
    const auto why =
        changed.conflicts.empty() ? "" : ": " + changed.conflicts[0].sentence;
    return say("{}: no feasible plan{}", a.name, why);
  }
  if (!a.saves_per_part)
    return say("{}: makes the part feasible, at {:.4f} in {:.3f} min", a.name,
               a.cost_per_part, a.time_per_part_min);
  const double seconds = *a.saves_min_per_part * kSecondsPerMinute;
  const bool same =
      std::abs(*a.saves_per_part) <= kCertificates * own.cost_per_part &&
      std::abs(*a.saves_min_per_part) <= kCertificates * own.time_per_part_min;
  if (same) return say("{}: changes nothing", a.name);
  return say("{}: {} per part{}; {} per part", a.name, saves(*a.saves_per_part, ""),
             p.batch ? say(", {} per batch of {}", readable(std::abs(*a.saves_per_batch)),
                           readable(*p.batch))
                     : "",
             saves(seconds, " s"));
}

// The plan of a changed request, with edges in stock faced or not, whichever is better.
ProcessPlan planned(const PreparedPart& part) {
  auto plan = certified_plan(part);
  if (const auto other = faced_otherwise(part)) {
    auto otherwise = certified_plan(*other);
    if (is_better(part, otherwise, plan)) return otherwise;
  }
  add_explanation(part, plan);
  return plan;
}

// Plans the changed request and completes the answer to it.
void answer_one(const PreparedPart& p, const PreparedPart& part, const ProcessPlan& own,
                WhatIfAnswer& a) {
  const auto changed = planned(part);
  a.feasible = changed.status == PlanStatus::ok;
  a.cost_per_part = changed.cost_per_part;
  a.time_per_part_min = changed.time_per_part_min;
  if (a.feasible && own.status == PlanStatus::ok) {
    a.saves_per_part = own.cost_per_part - changed.cost_per_part;
    if (p.batch) a.saves_per_batch = *a.saves_per_part * *p.batch;
    a.saves_min_per_part = own.time_per_part_min - changed.time_per_part_min;
  }
  a.sentence = sentence(p, own, a, changed);
}

}  // namespace

void answer(const PreparedPart& p, const std::vector<WhatIf>& what_if,
            ProcessPlan& result) {
  side_by_side(what_if.size(), [&](std::size_t k) {
    answer_one(p, what_if[k].part, result, result.what_if[k]);
  });
}

void answer(const PreparedPart& p, const std::vector<WithoutRule>& without,
            ProcessPlan& result) {
  result.rules.resize(without.size());
  side_by_side(without.size(), [&](std::size_t k) {
    result.rules[k].name = without[k].name;
    answer_one(p, prepare(without[k].request), result, result.rules[k]);
  });
}

}  // namespace turnwright::planning
