#pragma once
#include "contour_cycle.hpp"
#include "modal_state.hpp"
#include "words.hpp"

/// Okuma's lathe auto-programming (LAP) along a contour that "NLAP1 G81" (longitudinal) or
/// G82 (transverse) begins and G80 ends:
///
///     G85 NLAP1 D U W F     passes at levels, then along the contour (AP mode I)
///     G86 NLAP1 D U W F     the contour again and again, nearer each time (AP mode II)
///     G87 NLAP1 U W         once along the contour
///
/// D, the depth of a pass, and U, what is left, are diameters; of a transverse contour D is a
/// length along Z, as W is.  The N-th pass of G86 begins, from the place Xs, Zs before it and
/// the contour's beginning Xa, Za, as diameters, at
///
///     Xp = Xs - N D,  Zp = Za + W + (Zs - Za - W)(1 - N D/(Xs - Xa - U)),              (1)
///
/// and transversely with X and Z exchanged; that which reaches Xa + U is the last.  The tool
/// comes back along Z, then X, but not with M85.
/// Source: [Okuma 5238-E], pages 195, 202 to 205, 218; the way out of each pass of G85 is
/// taken as Fanuc's.
namespace turnwright::review {

/// The moves of G85, G86 or G87 from where the tool stands.
void lap_cycle(ModalState& s, int code, const Block& block, const Contour& contour,
               RoughingAlong direction);

}  // namespace turnwright::review
