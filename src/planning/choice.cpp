#include "turnwright/planning/choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/say.hpp"
#include "certified_plan.hpp"
#include "completed_plan.hpp"
#include "planning/values/readable.hpp"
#include "planning/values/side_by_side.hpp"
#include "what_if.hpp"

namespace turnwright::planning {
namespace {

Alternative alternative(const std::string& name, const ProcessPlan& plan) {
  const bool feasible = plan.status == PlanStatus::ok;
  Alternative a{.name = name, .feasible = feasible};
  if (feasible) {
    a.cost_per_part = plan.cost_per_part;
    a.time_per_part_min = plan.time_per_part_min;
    a.lower_bound = plan.certificate.lower_bound;
  } else {
    a.why = plan.conflicts.empty() ? plan.certificate.reason
                                   : plan.conflicts.front().sentence;
  }
  return a;
}

int strength(CertificateKind kind) {
  return kind == CertificateKind::global ? 2 : kind == CertificateKind::local ? 1 : 0;
}

// What is proved of all candidates: that none costs less than the least lower bound.
void add(const Certificate& other, Certificate& c) {
  c.nodes += other.nodes;
  if (!(other.lower_bound < c.lower_bound)) return;
  const double best = c.lower_bound / (1 - c.gap);
  c.lower_bound = other.lower_bound;
  c.gap = (best - c.lower_bound) / best;
  if (strength(other.kind) < strength(c.kind)) {
    c.kind = other.kind;
    c.reason = other.reason;
  }
}

std::string sentence(const Alternative& a, const ProcessPlan& best, bool answer) {
  if (a.chosen) return say("{}: chosen", a.name);
  if (!a.feasible)
    return say("{}: {}no feasible plan{}{}", a.name,
               answer ? tr("comes closest, its conflicts are told; ") : "",
               a.why.empty() ? "" : ": ", a.why);
  const double more = *a.cost_per_part - best.cost_per_part;
  const double seconds = 60 * (*a.time_per_part_min - best.time_per_part_min);
  return fmt::format("{}: {}, {}", a.name,
                     more < 0 ? say("{} less per part", readable(std::abs(more)))
                              : say("{} more per part", readable(std::abs(more))),
                     seconds < 0 ? say("{} s shorter", readable(std::abs(seconds)))
                                 : say("{} s longer", readable(std::abs(seconds))));
}

// Plans without explanations, and what becomes of them in the judge's eyes and by the
// preference of proven conditions.
struct Compared {
  std::vector<ProcessPlan> certified, judged;
  std::vector<Shortfall> shortfalls;   // before the judge
  std::vector<std::string> set_aside;  // why, else empty
};

void set_aside(const std::string& why, std::size_t i, Compared& all) {
  auto& plan = all.judged[i];
  if (plan.status != PlanStatus::ok) return;
  plan.status = PlanStatus::infeasible;
  auto& conflict = plan.conflicts.emplace_back();
  conflict.limit = to_translate("rules");
  conflict.sentence = all.set_aside[i] = why;
}

// Of the plans at proven conditions and those at any the ones or the others are set aside.
void prefer_proven(const std::vector<Candidate>& candidates, Compared& all) {
  constexpr double kPercent = 100;
  double proven = INFINITY, any = INFINITY, within = 0;
  const auto value = [&](std::size_t i) {
    const bool feasible = all.judged[i].status == PlanStatus::ok;
    return feasible ? objective(candidates[i].part, all.judged[i]) : INFINITY;
  };
  for (std::size_t i = 1; i < candidates.size(); ++i) {
    if (!candidates[i].unless_within) continue;
    within = *candidates[i].unless_within;
    proven = std::min(proven, value(i - 1));
    any = std::min(any, value(i));
  }
  if (std::isinf(proven) || std::isinf(any)) return;
  const double more = (proven - any) / std::abs(any);
  const bool kept = more <= within;
  const auto why =
      say("set aside, proven conditions cost {} % more than others, {} than {} %",
          readable(kPercent * std::max(0.0, more)), kept ? tr("not more") : tr("more"),
          readable(kPercent * within));
  for (std::size_t i = 1; i < candidates.size(); ++i)
    if (candidates[i].unless_within) set_aside(why, kept ? i : i - 1, all);
}

Compared compare(const std::vector<Candidate>& candidates, const Judge& judge) {
  Compared all{std::vector<ProcessPlan>(candidates.size()),
               std::vector<ProcessPlan>(candidates.size()),
               std::vector<Shortfall>(candidates.size()),
               std::vector<std::string>(candidates.size())};
  side_by_side(candidates.size(), [&](std::size_t i) {
    const auto& c = candidates[i];
    auto nearest = nearest_plan(c.part, c.what_if);
    all.shortfalls[i] = nearest.shortfall;
    all.certified[i] = std::move(nearest.plan);
    all.judged[i] = all.certified[i];
    judge(c.part, all.judged[i]);
  });
  prefer_proven(candidates, all);
  return all;
}

std::size_t best_of(const std::vector<Candidate>& candidates, const Compared& all) {
  const auto& plans = all.judged;
  const auto feasible = [&](std::size_t i) { return plans[i].status == PlanStatus::ok; };
  const auto better = [&](std::size_t i, std::size_t best) {
    return feasible(i) || feasible(best)
               ? is_better(candidates[i].part, plans[i], plans[best])
               : all.shortfalls[i] < all.shortfalls[best];
  };
  std::size_t best = 0;
  for (std::size_t i = 1; i < plans.size(); ++i)
    if (better(i, best)) best = i;
  // Without any plan, why there is none at any conditions is told.
  const bool proven = best + 1 < plans.size() && candidates[best + 1].unless_within;
  return !feasible(best) && proven ? best + 1 : best;
}

void add_alternatives(const std::vector<Candidate>& candidates, const Compared& all,
                      ChosenPlan& choice) {
  auto& plan = choice.plan;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const auto& aside = all.set_aside[i];
    auto a =
        alternative(candidates[i].name, aside.empty() ? all.judged[i] : all.certified[i]);
    a.chosen = i == choice.chosen && a.feasible;
    if (a.feasible && !a.chosen && aside.empty())
      add(all.judged[i].certificate, plan.certificate);
    a.sentence = sentence(a, plan, i == choice.chosen);
    if (!aside.empty()) a.sentence += ": " + aside;
    plan.alternatives.push_back(std::move(a));
  }
}

}  // namespace

std::vector<ProcessPlan> judged_plans(const std::vector<Candidate>& candidates,
                                      const Judge& judge) {
  return compare(candidates, judge).judged;
}

ChosenPlan choose(const std::vector<Candidate>& candidates, const Judge& judge) {
  if (candidates.empty()) throw std::domain_error("choose: no candidate");
  const auto complete = [&](std::size_t i, ProcessPlan certified) {
    const auto& c = candidates[i];
    ChosenPlan choice{i, completed_plan(c.part, c.what_if, std::move(certified))};
    answer(c.part, c.without, choice.plan);
    judge(c.part, choice.plan);
    return choice;
  };
  for (const auto& c : candidates)
    if (c.part.objective == Objective::profit && !c.part.price)
      throw std::domain_error("choose: the most profitable plan needs a price");
  if (candidates.size() == 1)
    return complete(0, certified_plan(candidates[0].part, candidates[0].what_if));
  const auto all = compare(candidates, judge);
  const auto best = best_of(candidates, all);
  auto choice = complete(best, all.certified[best]);
  add_alternatives(candidates, all, choice);
  return choice;
}

}  // namespace turnwright::planning
