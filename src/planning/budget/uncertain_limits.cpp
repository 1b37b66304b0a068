#include "uncertain_limits.hpp"

#include <cmath>

#include "turnwright/base/distributions.hpp"

namespace turnwright::planning {
namespace {

double limit_spread(const PlanRequest& p) { return p.damping_uncertainty_pct / 100; }

// z of Eq. (2); none of a nominal plan.
double standard_deviations(const PlanRequest& p) {
  return p.robust ? -normal_quantile((1 - p.conformance) / 4) : 0;
}

}  // namespace

double chatter_factor(const PlanRequest& p) {
  if (!(limit_spread(p) > 0)) return 1;
  return std::exp(-standard_deviations(p) * limit_spread(p));  // Eq. (2)
}

double stable_probability(const PlanRequest& p, double share) {
  if (!(limit_spread(p) > 0) || !(share > 0)) return 1;
  const double z = standard_deviations(p) - std::log(share) / limit_spread(p);
  return normal_probability(z);
}

double left_by_chatter(const PlanRequest& p) { return limit_spread(p) > 0 ? 0.5 : 1; }

double roughness_factor(const PlanRequest& p, double u_pct) {
  if (!p.roughness_conformance) return 1;
  return 1 + normal_quantile(*p.roughness_conformance) * u_pct / 100;  // Eq. (3)
}

}  // namespace turnwright::planning
