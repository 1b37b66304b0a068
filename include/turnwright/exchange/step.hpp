#pragma once
#include <string>
#include <string_view>

#include "turnwright/exchange/outline.hpp"

namespace turnwright::exchange {

struct StepOptions {
  /// Which solid, if the file holds several: its name, or its number in their order from 1.
  /// Empty: the only one.
  std::string body = {};
};

/// The turned part in a STEP file of AP203, AP214 or AP242.
///
/// **Axis.** Cylinders, cones and tori about one line belong together; the line with the
/// largest area of them is the axis, wherever it lies.  Placements of assemblies do not
/// matter and are not read.
///
/// **Direction.** z = 0 is the end with the smaller coordinate in the file: along x, unless
/// the axis is perpendicular to x, then along y, else along z.  Which faces there are and
/// how they are divided has no influence.
///
/// **Contour.** Circles about the axis are the corners of the half profile, faces about it
/// the sides; what lies between two corners counts as whole although keyways, flats and
/// cross holes cut through it.  A face whose circles lead nowhere, the end of a flat for
/// instance, is no side.
///
/// **Milled places.** Keyways and slots (a floor parallel to the axis between two walls, ends
/// round or square) and flats, on outer cylinders.  Their angle is counted from the file's
/// z axis, from its x axis if the part lies along z, counterclockwise when the part is seen
/// from its right end.  Everything else is told under `ignored`, face by face.
///
/// Lengths are in the units of the file, which it names (SI units, inches).
///
/// The text must stay until the function returns.
/// @throws InputError if the text is no STEP file; holds no solid, or several without a
///         choice; or is no turned part: nothing turns about an axis, a corner lies outside
///         the largest circle about it, less than a third of that circle is there, or the
///         contour does not close.
Outline read_step(std::string_view text, const StepOptions& options = {});

}  // namespace turnwright::exchange
