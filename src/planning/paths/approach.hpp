#pragma once

/// Distances [mm] that a program's tools keep from the part, and that they run beyond the
/// surfaces they cut.  The planned time uses the same distances.
namespace turnwright::planning {

inline constexpr double kBefore_mm = 2;  ///< from the start of a pass to its surface
inline constexpr double kAbove_mm = 1;   ///< height above it at which a tool comes in
inline constexpr double kAboveBore_mm = 0.2;  ///< the same in a bore
inline constexpr double kBehind_mm = 0.2;     ///< overrun of a pass behind a falling edge
inline constexpr double kPeck_mm =
    0.5;  ///< before the depth reached, from where pecks are fed
inline constexpr double kClear_mm = 2;    ///< of rapids along the axis above the stock
inline constexpr double kChange_mm = 50;  ///< from the stock to where tools are changed

}  // namespace turnwright::planning
