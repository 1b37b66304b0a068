#pragma once
#include "turnwright/catalogue/tool.hpp"

namespace turnwright::planning {

/// Compliance of a boring bar's tip: y_w, y_p, y_t of yielding.hpp (3), per passive, feed
/// and cutting force [mm/N].
struct BarTip {
  double w = 0, p = 0, t = 0;
};
BarTip tip_of(const catalogue::BoringBar& bar);

}  // namespace turnwright::planning
