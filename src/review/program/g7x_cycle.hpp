#pragma once
#include <optional>

#include "contour_cycle.hpp"
#include "modal_state.hpp"
#include "words.hpp"

/// LinuxCNC's cycles along the contour of a subroutine:
///
///     G71 Q X Z D I R   passes along Z by I, back by R, then along the contour; G71.1 too
///     G72 Q X Z D I R   the same along X; G72.1
///     G70 Q X Z D E P   P times along the contour, from D to E beside it
///
/// X, Z is the place from which they begin, by default where the tool stands.  Passes begin on
/// the line from there to the contour's first point, the first at that place itself; D keeps
/// them, and the last way along the contour, beside it, around its outer corners.  The tool
/// stays at the end.  Contours that go one way in X and in Z are followed.
/// Source: [LinuxCNC 2.9], its documentation of G70 to G72; linuxcnc_test runs its interpreter.
namespace turnwright::review {

/// @throws NotFollowed if the contour or the words cannot be.
void g7x_cycle(ModalState& s, int code, const Block& block, const Contour& contour);

}  // namespace turnwright::review
