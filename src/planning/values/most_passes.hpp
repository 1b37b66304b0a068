#pragma once

namespace turnwright::planning {

/// Passes of an operation, at most.  Widths and depths of tools may be any numbers above 0;
/// with tiny ones a surface would take more passes than memory holds.
inline constexpr int kMostPasses = 1000;

}  // namespace turnwright::planning
