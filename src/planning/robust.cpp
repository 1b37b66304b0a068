#include <cmath>

#include "feature_optimiser.hpp"
#include "planned.hpp"

namespace turnwright::planning {
namespace {

constexpr int kRounds = 4;
constexpr double kConforms = 1e-6;
constexpr double kBothSigns = -1;

// From the deviation of a size that goes furthest to the one at its other end, as a share
// of it; both ends alike of what has no two ends.
double other_end(const part::Tolerance& t, const ToleranceResult& r) {
  if (t.kind != part::ToleranceKind::diameter) return kBothSigns;
  const double middle = (t.limits->upper_mm + t.limits->lower_mm) / 2;
  const double low = r.predicted_mm[0] - middle, high = r.predicted_mm[1] - middle;
  return std::abs(low) > std::abs(high) ? high / low : low / high;
}

// Asks more of the tolerances that do not conform; false if none is left to ask.
bool asked_more(const ProcessPlan& result, bool as_they_are, PreparedPart& p) {
  bool more = false;
  for (std::size_t i = 0; i < result.tolerances.size(); ++i) {
    const auto& r = result.tolerances[i];
    if (r.P_conform >= p.conformance - kConforms) continue;
    const auto [end, fresh] = p.other_ends.try_emplace(r.id, 0);
    if (!fresh && end->second == kBothSigns) continue;
    end->second = as_they_are ? other_end(p.drawing.tolerances[i], r) : kBothSigns;
    more = true;
  }
  return more;
}

// What is asked of both ends is enough, not necessary: only the bound of the first plan,
// which was asked for one, holds for every plan that conforms.
void bound_by(double first, ProcessPlan& r) {
  auto& c = r.certificate;
  if (r.status != PlanStatus::ok || !(first < c.lower_bound)) return;
  const double objective = c.lower_bound / (1 - c.gap);
  c.lower_bound = first;
  c.gap = (objective - first) / std::abs(objective);
  if (c.gap <= kCertified || c.kind != CertificateKind::global) return;
  c.kind = CertificateKind::local;
  c.reason =
      "a size would fail at both of its limits: what is asked of both is enough, "
      "the bound asks for one";
}

}  // namespace

ProcessPlan conforming(PreparedPart p, const std::vector<WhatIf>& what_if, Why why) {
  auto result = planned(p, what_if, why);
  if (!p.robust) return result;
  const double bound = result.certificate.lower_bound;
  for (int round = 0; result.status == PlanStatus::ok; ++round) {
    if (!asked_more(result, round < kRounds, p)) return result;
    result = planned(p, what_if, why);
    bound_by(bound, result);
  }
  return result;
}

}  // namespace turnwright::planning
