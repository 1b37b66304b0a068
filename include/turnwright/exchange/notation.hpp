#pragma once
#include <string>
#include <string_view>

#include "turnwright/exchange/outline.hpp"

/// A turned part as a line of text, the way it is said at a drawing:
///
///     d50 h7 x 40 Ra1.6; d30 k6 x 32; M24x1.5 x 25; bore d20 H7 x 60
///
/// Statements end with ';' or a line break; they stand in any order but for the elements
/// and the corners between them, which are read from left to right.  [ ] may be left out,
/// { } may be repeated, | divides choices:
///
///     element   = [bore [left | right]] shape [FIT | limits] x LENGTH {FIT | Ra N | Rz N | grind N}
///     shape     = d D | [cone] d D-d D | arc d D-d D R RADIUS [convex | concave]
///               | stock (d D | hexA | squareA) | groove d D | hole d D | M D[x PITCH] | INCHES-N [UNC | UNF | ..]
///     limits    = UPPER/LOWER | ±N                           +0.02/-0.01  +0.1/0  ±0.05
///     corner    = feature {feature}
///     feature   = AxANGLE | chamfer AxANGLE | round RADIUS | R RADIUS     1x45  round2
///               | E RxT | F RxT | DIN76-A | DIN76-B                       E0.8x0.3
///     edge      = EDGE: corner                               left: 1x45   right|b1: 1x30
///     face      = face FACE (Ra N | Rz N) ..                 face d1|d2 Ra1.6
///     tolerance = KIND OF [to DATUM] N                       cylindricity d2 0.008
///               | diameter ELEMENT limits | length FACE to FACE limits
///     milled    = (keyway | slot) WxTxL on ELEMENT at Z [angle A] [times N] | flat TxL on ..
///               | cross-hole d D [FIT | limits] (x T | through [wall | part]) on ..  cross-hole d6 x 8 on d2 at 30
///     centre    = centre (left | right) (A | B | R) D/D          centre right A4/8.5
///     title     = (name | material | general | drawing | revision | customer): TEXT
///     unit      = unit: (mm | in)
///
/// - Diameters, lengths, radii, widths in mm, roughness in um, angles in degrees.  D is the
///   floor of a groove and the nominal diameter of a thread, whose pitch is the coarse one
///   of ISO 261 where none is written.  The pitch is written without a blank, "M24x1.5 x
///   25", or before the length, "M24 x 1.5 x 25".  Inch threads of N threads per inch are
///   written "1/2-13 UNC 2A x 25", "1-1/4-7 x 40", "#10-24 UNC x 12" (part/inch_thread.hpp).
/// - `stock` stays as the bar is, round, or a hexagon or square bar of A across its flats.
/// - A corner that stands between two outer elements is the edge between them, before the
///   first one the left end's, after the last one the right end's.  Edges of bores are
///   named.  A is measured along the axis, ANGLE from the axis; E RxT is form E of DIN 509,
///   and so on to H.
///   `round` is the radius of the edge, R the largest fillet of the inner corner at its foot;
///   at an end, where no inner corner is, R too is the radius of the edge.
/// - Outer elements are named d1, d2 .. from left to right, grooves and threads counted too.
///   Bores are named b1, b2 .. in the order in which they are written; those of one end from
///   it inwards, at the right end unless it says left.  EDGE and FACE are "left", "right" or
///   two neighbours, "d1|d2"; KIND is a name of part/tolerance_kind.hpp.  DATUM is one of
///   these, or two elements for their common axis, "d2-d6".
/// - T and Z of a milled place: depth below the rim of the cylinder, and its left end
///   measured from the left end of the part; of a cross hole its middle.  One goes through the
///   wall, into the bore, or through the part, out of the other side, as where neither is said.
/// - Ø or ⌀ stand for d, × for x, +- or +/- for ±, 45° for 45.  A comma between digits is a
///   decimal comma: d50,5.  Blanks between a letter and its number do not matter (x40, Ra
///   1.6).  Neither does the case of words; that of fits is kept, R7 of a bore is a fit.
/// - With "unit: in" lengths and limits are inches, roughness microinches; the outline is in mm
///   all the same.  Threads and the designations of standards keep their own units.
/// - TEXT may stand in '"', in which a ';' is a part of it and '""' one '"'.
namespace turnwright::exchange {

/// The outline of a notation.  Whether the part can be made, whether a fit is one of ISO
/// 286, an edge one that takes a chamfer, is for the part document to say.
/// @throws InputError naming every mistake by line and column: what cannot be read, a size
///         that is not > 0, an element without a length, an id that no element has.
Outline read_notation(std::string_view text);

/// The outline in this notation, a statement a line; `read_notation` gives it back.  Ids of
/// elements are d1, b1 .., those of tolerances and milled places t1, m1 .. in their order,
/// edges stand in their order along the part.  `sources`, `assumed` and `ignored` are left out, line breaks in texts
/// become blanks, numbers keep all their digits.
std::string notation(const Outline& outline);

}  // namespace turnwright::exchange
