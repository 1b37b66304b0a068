#pragma once
#include <cstddef>
#include <string>

#include "site.hpp"

/// Keyways, slots, flats and cross holes, cut by a driven tool while the main spindle holds
/// the part.
///
/// The cutter stands along X, its end towards the spindle's axis; moves are those of the
/// middle of its end.  It goes along Z in the layers and lanes of the plan, whose feed it
/// has; planning/auxiliary/milled_paths.hpp has their lengths.
///
///     depth    the floor of a layer k of r is at the radius R - depth k/r, R as drawn
///     closed   the middle ends D/2 before the end, which keeps the cutter's round
///     open     it comes in from D/2 and 2 mm outside, and runs out D/2
///     keyway   plunges at kPlungeFeed where the layer before ended; a wider one than its
///              cutter is opened in the middle, then both sides are down-milled
///     flat     lanes of equal width from one side to the other, down-milled; one that is
///              closed at both ends is entered from the side
///     cross hole  from 1 mm above the cylinder down to the depth of the drill's tip
///              (planning/auxiliary/cross_holes.hpp), out after every peck
///     angle    C turns like a screw towards +Z; drawings count about the part's own z
///
/// Down-milling, with the cutter turning clockwise: material is on the right of its way.
/// Source: derived here; milled_test cuts a round bar with the moves.
namespace turnwright::nc {

/// Why a milled operation, whose moves are the site's, is not in the program: the machine
/// cannot hold the part at an angle, or not at the right one, its axis Y does not reach, or
/// the cutter cannot go down into solid material.  Empty if it is.
std::string not_milled(const Site& site, const planning::OperationPlan& o);

/// Its conditions.
Milling milling_of(const Site& site, const planning::OperationPlan& o);

/// Appends the moves of the operation to the site's.
void mill(Site& site, std::size_t operation);

}  // namespace turnwright::nc
