#pragma once
#include <utility>
#include <vector>

#include "turnwright/cutting/milled.hpp"
#include "turnwright/planning/setup_geometry.hpp"

/// The ways of a cutter through a milled place.
namespace turnwright::planning {

/// A kind of cut in it.
struct Engagement {
  double ae_mm = 0, immersion = 0;  ///< ae over the cutter's diameter
  cutting::MilledChip chip;
};

/// The widest first, (1) and (2) of milled_places.hpp.
std::vector<Engagement> engagements(const Milled& place,
                                    const catalogue::MillingCutter& cutter, int lanes);

/// Ends at which the cutter runs out: what lies beyond, as far as it runs, is lower than
/// the floor once the setup is done, and neither jaws nor a centre are there.
struct RunOut {
  bool left = false, right = false;
};
RunOut run_out(const PartPlan& plan, std::size_t setup, Clamping clamping,
               const Milled& place, double dc_mm);

/// Ways of the cutter's centre in one layer [mm]; a plunge counts its depth over
/// kPlungeFeed.
///
///     lane:  length - D closed at both ends, + kApproach at one that is open, from
///            where the cutter is clear: length + kApproach, length + D + kApproach   (1)
///     sides of a keyway or slot: 2 (lane + w - D)                                    (2)
///     a flat that is closed at both ends is entered from the side: + D/2 + kApproach (3)
double layer_mm(const Milled& place, double dc_mm, int lanes, RunOut out);

/// Feed of a plunge over that along the part.
inline constexpr double kPlungeFeed = 0.3;

}  // namespace turnwright::planning
