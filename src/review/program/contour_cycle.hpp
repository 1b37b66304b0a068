#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "modal_state.hpp"
#include "words.hpp"

/// Roughing and finishing of a contour by Fanuc's G70 to G73, as plain moves.
namespace turnwright::review {

/// A contour as the blocks between P and Q command it from where the cycle begins.
struct Contour {
  std::vector<Run> runs;  ///< with the feeds of the blocks
};

/// What of a contour's cycle the moves follow from.
struct ContourCycle {
  const char* name = "G71";
  double depth_mm = 0, retract_mm = 0;    ///< of each pass, on the radius
  double left_x_mm = 0, left_z_mm = 0;    ///< for finishing: on the radius, < 0 in bores
  double shift_x_mm = 0, shift_z_mm = 0;  ///< of the first pass of G73, on the radius
  double passes = 0;                      ///< of G73
  bool comes_back = true;                 ///< to where it began
};

/// Passes from where the tool stands to the contour with what is left on it, each with a
/// way out at 45 deg, then once along this contour, and back: along Z (G71), or along X
/// (G72).  The contour must rise or fall all the way in X and in Z (type I); others are
/// listed as unknown.
enum class RoughingAlong { z, x };
void rough(ModalState& s, const Contour& contour, const ContourCycle& cycle,
           RoughingAlong along);

/// Stock removal as CYCLE95 of Siemens does it, from where it begins itself: beside the
/// contour's end and before its beginning by the distance of its retracts.
struct StockRemoval {
  double depth_mm = 0;  ///< the largest, of passes that are alike
  double left_x_mm = 0, left_z_mm = 0,
         left_mm = 0;                      ///< along X, Z and normal to the contour
  double rough_feed = 0, finish_feed = 0;  ///< 0: that in force, of the blocks
  double retract_mm = 1;
  bool roughs = true, finishes = true;
  bool corners = true;  ///< each pass goes on along the contour to the one before
  bool inside = false;
};

/// Roughing passes of one depth to the contour with what is left, then the contour with the
/// nose's compensation, as the control switches it on itself.  Contours that go one way in X
/// and in Z are followed.
/// Source: [Siemens 808D], page 187; of the depths that all are alike: from knowledge of the
/// cycle, not opened.
void remove_stock(ModalState& s, const Contour& contour, const StockRemoval& cycle,
                  RoughingAlong along);

/// The contour with what is left on it, moved by a shift that falls evenly from its whole at
/// the first pass to none at the last (G73).
void repeat_pattern(ModalState& s, const Contour& contour, const ContourCycle& cycle);

/// Along the contour and back to where the tool stood (G70).
void finish(ModalState& s, const Contour& contour);

/// The contour's moves as feeds, shifted, at the feed in force.
void along(ModalState& s, const Contour& contour, double dx_mm, double dz_mm);

/// The contour's moves, shifted, with the feeds and the compensation of its blocks.
void follow_contour(ModalState& s, const Contour& contour, double dx_mm, double dz_mm);

/// G70 to G73 in two blocks, of which the first sets depths and passes, or in one:
///
///     G71 U(depth) R(retract)             G71 P Q U W F            G71 P Q U W D(depth) F
///     G72 W(depth) R(retract)             G72 P Q U W F            G72 P Q U W D(depth) F
///     G73 U(shift) W(shift) R(passes)     G73 P Q U W F      G73 P Q I K U W D(passes) F
///
/// What is left, U, is a diameter, the other lengths along X are radii.
/// Source: [Lathe cycles] in docs/bibliography.md.
class ContourCycleReader {
 public:
  /// The contour between two blocks; none if there are no such.
  using Between = std::function<std::optional<Contour>(double P, double Q)>;
  /// The block's cycle; the last block of its contour, behind which the program goes on.
  std::optional<double> take(ModalState& s, gcode::Control control, int code,
                             const Block& block, const Between& between);

 private:
  void set(const ModalState& s, int code, const Block& block);
  ContourCycle cycle_;
};

}  // namespace turnwright::review
