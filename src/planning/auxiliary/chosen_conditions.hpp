#pragma once
#include <functional>
#include <vector>

#include "turnwright/catalogue/fixed_tool.hpp"

/// Speed and feed of an operation whose passes are fixed, within the window that the tool's
/// document gives.
namespace turnwright::planning {

struct SpeedAndFeed {
  double vc_m_min = 0, f_mm_rev = 0;
};

/// The objective at some conditions, for time and for worn edges, and whether all limits are
/// kept.
struct ConditionsTrial {
  double of_time = 0;   ///< A/f and what does not depend on f
  double of_edges = 0;  ///< B f^(y-1)
  bool feasible = true;
};

/// The best of a window of speeds and feeds, at most a billionth dearer than the least:
///
///     C(v, f) = A(v)/f + B(v) f^(y-1),   f*(v) = (A/((y-1) B))^(1/y)                 (1)
///
/// with y the exponent of the feed in the life (fixed_tool.hpp).  Lower speeds and lower feeds
/// keep every limit that higher ones keep, so f*(v) is cut off at the largest feed that is
/// allowed.  Objective and limits are posynomials in v and f as far as one range of the
/// spindle goes, so what is left is convex in ln v there.  Brent's method finds the minimum
/// without limits; if it breaks any, golden section finds the one of each range.  If no
/// conditions of the window keep the limits, those of the lowest speed and feed.
///
/// `breaks_m_min`: speeds at which a range of the spindle ends.
/// Source: Boyd, Vandenberghe 2004, section 4.5, for the posynomials; Brent 1973 for his
/// method; derived here.
SpeedAndFeed best_conditions(
    const catalogue::ConditionsWindow& window, std::vector<double> breaks_m_min,
    const std::function<ConditionsTrial(const SpeedAndFeed&)>& trial);

}  // namespace turnwright::planning
