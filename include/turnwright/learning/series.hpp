#pragma once
#include <cstddef>
#include <optional>
#include <vector>

/// Measured values of one characteristic in the order of making.
namespace turnwright::learning {

struct Observation {
  double y_mm = 0;       ///< as measured
  double offset_mm = 0;  ///< corrections in force, as the change of y that they make
  /// When it was made: hours, or its number in the series where no times are known.
  double at = 0;
  std::size_t edge = 0;  ///< index of the edge that finished it, rising
  double age = 0;        ///< parts that this edge had cut before
};

using Series = std::vector<Observation>;

/// What a characteristic may be.  Without a lower limit it is one of form or place, whose
/// values are not negative.
struct Limits {
  double target_mm = 0;  ///< the middle of both limits unless the shop aims elsewhere
  double upper_mm = 0;
  std::optional<double> lower_mm = {};
};

/// A number with its standard uncertainty and the ends of its interval.
struct Estimate {
  double value = 0, u = 0, lower = 0, upper = 0;
};

/// value +- t u, with Student's t of these degrees of freedom (at least one).
Estimate student_interval(double value, double u, double degrees, double confidence);

}  // namespace turnwright::learning
