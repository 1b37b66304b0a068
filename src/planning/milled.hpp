#pragma once
#include "fixed.hpp"

/// Milled places of a setup: cutter, passes, speed and feed of least cost whose depth is
/// stable with its margin at every speed within the margin of speed.
namespace turnwright::planning {

/// With letters of cutting/milled.hpp and of milled_search.hpp, r passes of ap = depth/r:
///
///     t = r layer + plunge depth/kPlungeFeed, over fz z n                          (1)
///     fz <= hex/(hex/fz), feed_max/(z n), and by power, torque, strength and grip
///     P <= c n^s:  fz^(1-mc) <= 60e6 c n^(s-1)/(kc1.1 sum' ae ap z)                (2)
///     F <= F_max:  fz^(1-mc) <= F_max/(kc1.1 ap S)                                 (3)
///     W = ap (1 + margin) (1 + rho) kc1.1 (hm/fz)^-mc fz^-mc                       (4)
///
/// sum' ae is the largest of ae (hm/fz)^-mc; rho the part's compliance across the feed
/// at the place over the tool point's, which is taken to share its frequencies, at
/// most 1. Grip: cutting/spindle.hpp with the whole of sqrt(1 + (Kn/Kt)^2) F along the
/// part and around it, the spindle at rest.
void add_milled(const PartPlan& plan, std::size_t setup, Clamping clamping,
                const Economy& economy, FixedWork& out);

/// Adds the first losses over the speeds of cutter and spindle, to be drawn.
void add_lobes(const PartPlan& plan, OperationPlan& operation);

}  // namespace turnwright::planning
