#pragma once

/// How far a program's tools keep from a part, and how far they run beside the surfaces
/// they cut [mm].  Plans take their time from the same distances.
namespace turnwright::planning {

inline constexpr double kBefore_mm = 2;       ///< a pass starts so far before its surface
inline constexpr double kAbove_mm = 1;        ///< and comes in from so far above
inline constexpr double kAboveBore_mm = 0.2;  ///< in a bore
inline constexpr double kBehind_mm = 0.2;  ///< a pass ends so far behind a falling edge
inline constexpr double kClear_mm = 2;     ///< rapids along the axis above the stock
inline constexpr double kChange_mm = 50;   ///< from the stock, where tools are changed

}  // namespace turnwright::planning
