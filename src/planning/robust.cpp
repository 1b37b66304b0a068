#include <cmath>

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
bool asked_more(const ProcessPlan& result, bool as_they_are, PartPlan& p) {
  bool more = false;
  for (std::size_t i = 0; i < result.tolerances.size(); ++i) {
    const auto& r = result.tolerances[i];
    if (r.P_conform >= p.conformance - kConforms) continue;
    const auto [end, fresh] = p.other_ends.try_emplace(i, 0);
    if (!fresh && end->second == kBothSigns) continue;
    end->second = as_they_are ? other_end(p.drawing.tolerances[i], r) : kBothSigns;
    more = true;
  }
  return more;
}

}  // namespace

ProcessPlan conforming(PartPlan p, const std::vector<WhatIf>& what_if, Why why) {
  auto result = planned(p, what_if, why);
  if (!p.robust) return result;
  for (int round = 0; result.status == PlanStatus::ok; ++round) {
    if (!asked_more(result, round < kRounds, p)) break;
    result = planned(p, what_if, why);
  }
  return result;
}

}  // namespace turnwright::planning
