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

/// The cuts of milled_places.hpp, (1) and (2), the widest first.
std::vector<Engagement> engagements(const Milled& place,
                                    const catalogue::MillingCutter& cutter, int lanes);

/// Those that a cutter passes through on the way: the outer lanes of a flat and the upper
/// layers' are narrower, the corners of a keyway wider than its sides.  In a flip lobe a
/// narrower cut can be the less stable one.
std::vector<Engagement> engagements_between(const Milled& place,
                                            const catalogue::MillingCutter& cutter,
                                            int lanes);

/// Ends at which the cutter runs out: what lies beyond, as far as it runs, is lower than
/// the floor once the setup is done, and neither jaws nor a centre are there.
struct RunOut {
  bool left = false, right = false;
};
RunOut run_out(const PreparedPart& plan, std::size_t setup, Clamping clamping,
               const Milled& place, double dc_mm);

/// How deep below what stands beside the place its floor lies [mm], as far from the
/// cutter's way as its holder reaches: kHolder_mm.
double depth_beside_mm(const PreparedPart& plan, std::size_t setup, const Milled& place,
                       double dc_mm, RunOut out);
inline constexpr double kHolder_mm = 25;  ///< radius: a nut of size ER 32

/// Ways of the cutter's centre in one layer [mm]; a plunge counts its depth over
/// kPlungeFeed.
///
///     lane:  length - D closed at both ends, + kApproach at one that is open, from
///            where the cutter is clear: length + kApproach, length + D + kApproach   (1)
///     sides of a keyway or slot: 2 (lane + w - D)                                    (2)
///     a flat that is closed at both ends is entered from the side: + D/2 + kApproach (3)
double layer_mm(const Milled& place, double dc_mm, int lanes, RunOut out);

/// What lengths that should be equal may differ by.
inline constexpr double kSlack_mm = 1e-9;

/// Feed of a plunge over that along the part.
inline constexpr double kPlungeFeed = 0.3;

}  // namespace turnwright::planning
