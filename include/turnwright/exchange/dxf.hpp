#pragma once
#include <optional>
#include <string_view>

#include "turnwright/exchange/outline.hpp"

/// The turned part that a DXF drawing shows.
namespace turnwright::exchange {

struct DxfOptions {
  /// Ends of lines this far apart or less are one corner; what was bridged is told.
  double join_mm = 1e-3;
  /// Length of one unit of the drawing, in place of what the file says of it.
  std::optional<double> unit_mm = {};
};

/// The half profile of a drawing of one turned part, as elements, and what its dimensions
/// say.  ASCII DXF of AutoCAD R12 to 2018; LINE, ARC, LWPOLYLINE, POLYLINE, also of blocks.
///
/// The unit is $INSUNITS, else $MEASUREMENT, else mm.  The axis is, in this order: a centre
/// line (by its line type CENTER or its layer's name); the line on which an open half
/// profile ends; y = 0 or x = 0 if a half profile is closed along it; the axis of symmetry
/// of a full profile; y = 0 or x = 0 if the contour ends there.  The part is drawn along any direction: its left end is that of smaller x,
/// or of smaller y where the axis is upright.
///
///     half profile   the lines on one side of the axis, closed along it or open there
///     full profile   both halves; their outer contours must agree, and bores are taken
///                    from the half that shows them (a half section)
///     outer contour  the outermost lines; shoulder lines across it are understood
///     bores          lines from an end face to the axis or to the other end face, hidden
///                    ones where the drawing has such, else solid ones of a section
///
/// Layers that are frozen, off, or by name of dimensions, hatching, texts or frames are no
/// contour.  Dimensions whose definition points lie on an element give it their fit, limits,
/// thread and roughness; those between two faces with limits are tolerances of length; the
/// rest of texts and entities is listed under `ignored`, guesses under `assumed`.
///
/// Bounds: 5000 lines and arcs after blocks are drawn out, blocks nested 16 deep.
/// @throws InputError naming the line or the entity ("LINE 2F"), or the coordinates of a
///         gap: a file that breaks off, binary DXF, SPLINE or ELLIPSE in the contour, no
///         axis, open or branching contours, halves that differ, what outline_of refuses.
Outline read_dxf(std::string_view text, const DxfOptions& options = {});

}  // namespace turnwright::exchange
