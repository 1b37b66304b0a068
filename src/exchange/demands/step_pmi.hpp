#pragma once
#include "pmi.hpp"

/// PMI of a STEP file on the outline of the turned part that was read from its faces.
namespace turnwright::exchange {

/// Adds to the outline what the file demands of the faces that its elements, shoulders and
/// ends were read from:
///
///     diameter with limits or a fit             -> fit, limits of the element
///     diameter with a note like M24x1.5-6g      -> thread
///     distance or thickness between two planes  -> `length`, id "t1", "t2" ..
///     geometric tolerance with at most one datum, or a common datum A-B of two elements,
///     without modifiers                         -> tolerance "t1" ..
///     Ra, Rz                                    -> demands of the element or face
///     part number, revision, material, ISO 2768 in a note -> title, material, general
///
/// Run-outs are radial on an element and axial on a face.  A tolerance of several elements
/// is one tolerance of each, as ISO 8015's independency has it.  Limits stay limits of
/// size: where the shape is modelled off the nominal size but within them they are moved.
///
/// All the rest is named in `ignored`, with its value and the reason: modifiers, further
/// datums, features that the outline does not have, angles, strokes without data.
/// Nothing becomes a tolerance without what qualifies it.
void add_pmi(const Pmi& pmi, Outline& outline);

/// The same from the file.
/// @throws InputError as read_pmi.
void add_pmi(const Exchange& file, Outline& outline);

}  // namespace turnwright::exchange
