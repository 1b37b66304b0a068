#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "turnwright/planning/changed_request.hpp"
#include "turnwright/planning/process_plan.hpp"
#include "turnwright/planning/rules.hpp"

namespace turnwright::planning {

/// A request among which a plan chooses, and the changes of it whose savings are asked.
struct Candidate {
  std::string name;
  PreparedPart part;
  std::vector<WhatIf> what_if = {};
  std::vector<WithoutRule> without = {};  ///< whose savings are told
  /// The candidate before this one has proven conditions, which this one has not.  The best
  /// of those is preferred if it costs at most so much more, as a share of the objective of
  /// the best of these.  Candidates agree on it.
  std::optional<double> unless_within = {};
};

struct ChosenPlan {
  std::size_t chosen = 0;  ///< index of the candidate
  ProcessPlan plan;        ///< of it, with what each candidate costs in `alternatives`
};

/// Makes a plan infeasible that cannot be carried out (nc::refuse_unprogrammed).  Called
/// by several threads at once.
using Judge = std::function<void(const PreparedPart&, ProcessPlan&)>;

/// The plan of each candidate without explanations, as the judge leaves it.  Candidates are
/// planned side by side on as many threads as the calling task arena has; no plan depends
/// on their number.
std::vector<ProcessPlan> judged_plans(const std::vector<Candidate>& candidates,
                                      const Judge& judge);

/// The plan of the candidate with the best objective; the first of equals.  Candidates
/// at proven conditions or those at any are set aside first.  Each candidate's
/// plan has its own certificate, so no candidate can be made for less than the least of their
/// lower bounds: the plan's certificate says so.  If none is feasible, the plan is that of
/// the candidate that comes closest and explains why: the one with the fewest surfaces that
/// cannot be made, then with the least sum of what these exceed their limits by; the first of
/// equals.  Candidates are planned side by side, as by judged_plans.
/// @throws std::domain_error without a candidate, or if profit is the objective and no price
///   is given.
ChosenPlan choose(const std::vector<Candidate>& candidates, const Judge& judge);

}  // namespace turnwright::planning
