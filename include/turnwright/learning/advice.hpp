#pragma once
#include "turnwright/learning/trend.hpp"

namespace turnwright::learning {

/// What to do before the next part.
///
///     correction = -(yhat - target)                                                  (1)
///     per part   = d step + w                                                        (2)
///     due in     floor[(min(U - target, target - L) - 3 s)/|per part|] parts         (3)
///
/// yhat is the expected value of the next part with the corrections now in force, (6) of
/// trend.hpp; step the time from part to part.  After a correction by (1) the trend (2) moves
/// the parts' middle; by (3) it is corrected again before the scatter of three standard
/// deviations reaches a limit.
/// Source: (1) to (3) derived here; advice_test.
struct Advice {
  Estimate expected_mm;     ///< yhat
  Estimate correction_mm;   ///< of the value as measured
  bool worthwhile = false;  ///< the interval of the correction does not contain 0
  double per_part_mm = 0;
  double room_mm =
      0;  ///< the bracket of (3); not positive: scatter alone fills the limits
  std::optional<long> due_in;  ///< parts; none where nothing moves, or within a million
};

/// @param next     time, edge and age of the next part, and the corrections in force.
/// @param step     of `at`, from part to part.
/// @param limits   with a lower one.
Advice advice(const Trend& trend, const Observation& next, double step,
              const Limits& limits, double confidence);

/// The part after the last one: one more on its edge, after the median of the steps.
struct Next {
  Observation part;
  double step = 0;
};
Next next_part(const Series& series);

}  // namespace turnwright::learning
