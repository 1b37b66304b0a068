#pragma once
#include <algorithm>

namespace turnwright::planning {

/// Passes of an operation, at most.  Widths and depths of tools may be any numbers above 0;
/// with tiny ones a surface would take more passes than memory holds.
inline constexpr int kMostPasses = 1000;

/// A whole number of passes, which may be larger than an int holds, counted from none to one
/// more than there may be.
inline int counted_passes(double passes) {
  return static_cast<int>(std::clamp(passes, 0.0, kMostPasses + 1.0));
}

}  // namespace turnwright::planning
