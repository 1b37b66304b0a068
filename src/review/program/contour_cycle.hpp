#pragma once
#include <vector>

#include "modal_state.hpp"

/// Roughing and finishing of a contour by Fanuc's G71 and G70, as plain moves.
namespace turnwright::review {

/// A contour as the blocks between P and Q command it from where the cycle begins.
struct Contour {
  std::vector<Run> runs;  ///< with the feeds of the blocks
};

struct RoughingCycle {
  double depth_mm = 0, retract_mm = 0;  ///< of each pass, on the radius
  double left_x_mm = 0, left_z_mm = 0;  ///< for finishing: on the radius, < 0 in bores
};

/// Passes along Z from where the tool stands to the contour with what is left on it, each
/// with a way out at 45 deg, then once along this contour, and back.  The contour must rise
/// or fall all the way in X and in Z (type I); others are listed as unknown.
void rough(ModalState& s, const Contour& contour, const RoughingCycle& cycle);

/// Along the contour and back to where the tool stood.
void finish(ModalState& s, const Contour& contour);

}  // namespace turnwright::review
