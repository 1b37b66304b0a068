#pragma once
#include <string>
#include <vector>

#include "turnwright/planning/plan_request.hpp"

/// Rules of the shop in a request: filters of its tools and ranges of their conditions, so
/// that a plan's certificate is that of all plans which keep them.
namespace turnwright::planning {

/// The request as its rules leave it:
///
/// - forbidden tools are taken out;
/// - house speeds cut the range of vc of every tool that they concern; tools for fixed
///   operations run at the largest speed allowed, where their own is larger;
/// - `n_max_rpm` is that of the machine, if its own is larger;
/// - tools with proven conditions in the material get their ranges, and serve alone what
///   they are used for.
///
/// Tools without conditions left are taken out.  Applied twice it changes nothing more.
PlanRequest ruled(PlanRequest request);

/// Whether a tool of the request has proven conditions in its material, and the planner
/// chooses: given operations have their conditions.
bool prefers_proven(const PlanRequest& request);

/// A request without one of its rules.
struct WithoutRule {
  std::string name;  ///< "without the rule that no spindle runs faster than 2500 rpm"
  PlanRequest request;
};

/// The request without each rule that changes something of it, one at a time.
std::vector<WithoutRule> without_each_rule(const PlanRequest& request);

}  // namespace turnwright::planning
