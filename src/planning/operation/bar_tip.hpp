#pragma once
#include "turnwright/catalogue/tool.hpp"

namespace turnwright::planning {

/// Compliance of a boring bar's tip: y_w, y_p, y_t of yielding.hpp (3), per passive, feed
/// and cutting force [mm/N]; y_z, its motion along the bar per force along it: the tip lies
/// beside the axis of a bar that bends; and y_a of (4), by which that force shortens the
/// bar, the sum of L/(E A) of its segments.
struct BarTip {
  double w = 0, p = 0, t = 0, z = 0, a = 0;
};
BarTip tip_of(const catalogue::BoringBar& bar);

}  // namespace turnwright::planning
