#pragma once
#include <span>
#include <string>

#include "turnwright/volumetric/ball_bar.hpp"
#include "turnwright/volumetric/compensation.hpp"
#include "turnwright/volumetric/machine.hpp"
#include "turnwright/volumetric/positioning.hpp"

/// Pictures of a machine's geometry (SVG 1.1, readable alone, 190 mm wide).  Equal data
/// give equal bytes.
namespace turnwright::report {

/// A circular test: both paths about their common centre, with their fit by the twelve
/// terms, at
///
///     radius on paper = 42 mm + factor (v - e_u cos theta - e_v sin theta)          (1)
///
/// with the values v, the common centre e, and the largest factor of 1, 2, 5, 10, .. that
/// keeps the traces between 28 and 56 mm.  Beside it are the amplitudes of the
/// undulations 2 to 8 of each path, and the ranking of the terms.
/// @throws ModelRangeError as volumetric::decompose.
std::string ball_bar_drawing(const volumetric::Trace& trace);

/// Distances of the tip from its targets, before and after the correction, along the
/// program, on a logarithmic scale.  If there are more moves than columns the largest
/// value of each column is drawn.  Values below 0.1 nm are drawn on the lower edge.
std::string compensation_drawing(const volumetric::Compensated& compensated);

/// Deviations of an axis by position, as ISO 230-2 draws them: the means in either direction,
/// thin beside them two standard deviations, and to the right between which deviations A, E and
/// M lie.  What the values lack is left out.
std::string positioning_drawing(char axis, const volumetric::Iso230_2& values);

/// The errors of each axis over -Q to Q (machine.hpp (1)), linear and angular errors
/// separately, and by direction of motion where they differ.  There is no band, because
/// coefficients have no uncertainty here.  Errors that are zero are omitted.
std::string error_map(const volumetric::Machine& machine);

}  // namespace turnwright::report
