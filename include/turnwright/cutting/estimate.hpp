#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

/// What every fit of a material's constants says of them.
namespace turnwright::cutting {

struct Estimate {
  double value = 0, lower = 0, upper = 0;
};

/// Measurements and scatter on which a fit rests.
struct Evidence {
  std::vector<std::size_t> used;      ///< indices of the measurements
  std::vector<std::size_t> outliers;  ///< indices left out of the fit, rising
  int degrees_of_freedom = 0;
  double s = 0;             ///< standard deviation of the logarithm of one measurement
  double s_prediction = 0;  ///< the same of a further cut at the mean of the conditions

  /// Replaces the index i of each measurement by names[i].
  void rename(const std::vector<std::size_t>& names);
};

/// A constant that the cuts do not determine, and a cut that would.
struct Missing {
  std::string parameter, test;
};

struct FitOptions {
  double confidence = 0.95;  ///< of every interval
  double outlier_p = 0.01;   ///< chance to find an outlier in good cuts; 0: keep all
};

/// One of the labs (shops, dynamometers, bars) whose cuts were fitted together.
struct Lab {
  std::size_t lab = 0;
  std::size_t measurements = 0;  ///< on which its factor rests
  Estimate factor;               ///< its constant over the pooled one
};
/// Labs as a random sample of all: the pooled constant is that of a lab not yet known, and
/// its interval holds for k - 1 degrees of freedom of k labs.
struct Labs {
  std::vector<Lab> each;
  double s_between = 0;  ///< standard deviation of ln F, or ln T, between labs
};

}  // namespace turnwright::cutting
