#include "turnwright/learning/advice.hpp"

#include <algorithm>
#include <cmath>

#include "median.hpp"

namespace turnwright::learning {

Advice advice(const Trend& trend, const Observation& next, double step,
              const Limits& limits, double confidence) {
  constexpr double kReach = 3, kMost = 1e6;
  Advice a;
  a.expected_mm = expected_mm(trend, next, confidence);
  const auto& e = a.expected_mm;
  const double target = limits.target_mm;
  a.correction_mm = {target - e.value, e.u, target - e.upper, target - e.lower};  // (1)
  a.worthwhile = !(e.lower <= target && target <= e.upper);
  a.per_part_mm = (trend.drift ? trend.drift->value * step : 0) +
                  (trend.wear ? trend.wear->value : 0);  // (2)
  a.room_mm =
      std::min(limits.upper_mm - target, target - *limits.lower_mm) - kReach * trend.s_mm;
  const double parts = std::max(0.0, a.room_mm) / std::abs(a.per_part_mm);  // (3)
  if (parts < kMost) a.due_in = static_cast<long>(parts);
  return a;
}

Next next_part(const Series& series) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < series.size(); ++i)
    steps.push_back(series[i].at - series[i - 1].at);
  Next next{series.back(), steps.empty() ? 0 : median(steps)};
  next.part.at += next.step;
  next.part.age += 1;
  return next;
}

}  // namespace turnwright::learning
