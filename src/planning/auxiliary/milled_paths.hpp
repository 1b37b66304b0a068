#pragma once
#include <utility>
#include <vector>

#include "turnwright/cutting/milled.hpp"
#include "turnwright/planning/prepared_part.hpp"

/// Geometry of a cutter's paths in a milled place.
namespace turnwright::planning {

/// One kind of cut in a milled place.
struct Engagement {
  double ae_mm = 0, immersion = 0;  ///< ae over the cutter's diameter
  cutting::MilledChip chip;
};

/// The cuts of milled_ways.hpp, (1) and (2), the widest first.
std::vector<Engagement> engagements(const Milled& place,
                                    const catalogue::MillingCutter& cutter, int lanes);

/// The intermediate cuts: outer lanes and upper layers of a flat are narrower than its
/// other cuts, and the corners of a keyway wider than its sides.  In a flip lobe a
/// narrower cut can be the less stable one.
std::vector<Engagement> engagements_between(const Milled& place,
                                            const catalogue::MillingCutter& cutter,
                                            int lanes);

/// Ends at which the cutter runs out.  The part beyond, as far as the cutter runs, is
/// lower than the floor once the setup is done, and neither jaws nor a centre are there.
struct RunOut {
  bool left = false, right = false;
};
RunOut run_out(const PreparedPart& plan, std::size_t setup, Clamping clamping,
               const Milled& place, double dc_mm);

/// Depth of the floor below the highest surface beside the place [mm], within the
/// distance kHolder_mm that the holder reaches from the cutter's path.
double depth_beside_mm(const PreparedPart& plan, std::size_t setup, const Milled& place,
                       double dc_mm, RunOut out);
inline constexpr double kHolder_mm = 25;  ///< radius: a nut of size ER 32

/// Approach and overrun of a cutter [mm].
inline constexpr double kApproach_mm = 2;

/// Length of the path of the cutter's centre in one layer [mm]; a plunge counts as its
/// depth divided by kPlungeFeed.
///
///     lane:  length - D closed at both ends; with one or two open ends, from where the
///            cutter is clear: length + kApproach, length + D + kApproach             (1)
///     sides of a keyway or slot: 2 (lane + w - D)                                    (2)
///     a flat that is closed at both ends is entered from the side: + D/2 + kApproach (3)
double layer_mm(const Milled& place, double dc_mm, int lanes, RunOut out);

/// Largest difference of lengths that should be equal.
inline constexpr double kSlack_mm = 1e-9;

/// Feed of a plunge over that along the part.
inline constexpr double kPlungeFeed = 0.3;

}  // namespace turnwright::planning
