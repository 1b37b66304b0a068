#pragma once
#include <optional>
#include <vector>

#include "turnwright/exchange/profile.hpp"

/// Centre holes in the ends of a half profile.
namespace turnwright::exchange {

/// The centre hole of ISO 6411 that a blind bore is: its pilot and where it is widest are
/// those of a row, both to 0.01 mm, and between them lie
///
///     form A: a cone of 60 deg
///     form B: a cone of 60 deg, and before it one of 120 deg that protects it
///     form R: an arc that bulges into the hole, on which a centre of 60 deg rests
///
/// Its bottom is flat or the point of a drill.  How deep the pilot goes is the centre drill's.
/// @param sides  of the bore from right to left, without the face at its mouth.
/// @param from   the end that it is drilled from.
std::optional<part::CentreHole> centre_hole_of(const std::vector<Side>& sides,
                                               part::End from, double join_mm);

/// Whether a blind bore looks like a centre hole, whatever its sizes: a cone of 60 deg at the
/// mouth, and behind it a hole of at most half its diameter, all of it no larger and deeper
/// than centre drills make it.
bool like_centre_hole(const std::vector<Side>& sides, double join_mm);

}  // namespace turnwright::exchange
