#pragma once
#include "turnwright/planning/plan_request.hpp"

/// Limits that are known only within a spread, and how far plans stay away from them.
namespace turnwright::planning {

/// The limits of chatter are uncertain by a factor exp(s Z), s = damping_uncertainty_pct and
/// Z standard normal, the same for all damping ratios of a cut.  A cut that chatters spoils
/// its surface, so that q = 1 - `conformance` is shared:
///
///     chatter of a surface may spoil q/4 of the parts, that of both faces of a length q/2;
///     q/2 are left to what moves and widens the sizes (left_mm)                      (1)
///
/// A robust plan holds every cut against its limit times
///
///     exp(-z s),  z the quantile of 1 - q/4                                          (2)
///
/// Factor (2); 1 of a nominal plan and where s = 0.
/// Source: derived here.
double chatter_factor(const PlanRequest& request);

/// Probability that a cut is stable whose chatter stiffness is this share of the limit that
/// the plan holds it against: P(share exp(-z s) <= exp(s Z)), 1 where s = 0.
double stable_probability(const PlanRequest& request, double share);

/// Share of the nonconforming parts that is left to sizes and forms: a half by (1), 1 where
/// s = 0.
double left_by_chatter(const PlanRequest& request);

/// Factor on a number u_pct uncertain, normally, with which the roughness rises: on hmin and
/// on the grooves of a wear land.  Both are judged at
///
///     1 + z u,  z the quantile of roughness_conformance                              (3)
///
/// times their value; as if both were at their quantiles at once, which is on the safe side.
/// 1 where no roughness_conformance is asked for.
double roughness_factor(const PlanRequest& request, double u_pct);

}  // namespace turnwright::planning
