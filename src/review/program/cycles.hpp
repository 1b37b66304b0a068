#pragma once
#include <optional>

#include "modal_state.hpp"
#include "words.hpp"

/// Cycles of controls as the plain moves they stand for.
namespace turnwright::review {

/// The boxes of system A from where the tool stands: along Z at a diameter and back
/// outside (G90), along X at a place and back beside it (G94), a cut of a thread (G92).
enum class Box { turning, facing, threading };
void box_cycle(ModalState& s, Box box, double x, double z, double lead_mm);

/// A tap from a place on the axis, at rapid from where the tool stands, to another one and
/// back, then to where it stood.
void tap_cycle(ModalState& s, double from_z_mm, double to_z_mm, double lead_mm);

/// All cuts of a thread by G76, from where the tool stands.
struct ThreadCycle {
  double outside_mm = 0;  ///< radius before the first cut; of a bore its wall
  double end_x_mm = 0;    ///< radius of the last cut
  double end_z_mm = 0;
  double first_mm = 0, least_mm = 0;  ///< infeeds
  double degression = 2;
  int spring_cuts = 0;
  double lead_mm = 0;
};
void thread_cycle(ModalState& s, const ThreadCycle& cycle);

/// G76 of a control; Fanuc's has two blocks, of which the first sets the least infeed.
class ThreadCycleReader {
 public:
  /// Whether the block was a cycle that could be read; tells what it could not.
  void take(ModalState& s, gcode::Control control, const Block& block);

 private:
  void linuxcnc(ModalState& s, const Block& block);
  void fanuc(ModalState& s, const Block& block);
  void haas(ModalState& s, const Block& block);

  double least_mm_ = 0;
};

/// Pecks of one axis, at places of the other, from where the tool stands and back.
struct PeckCycle {
  bool along_x = false;  ///< G75; G74 pecks along Z
  double to_x_mm = 0, to_z_mm = 0;
  double peck_mm = 0;     ///< 0: one stroke
  double retract_mm = 0;  ///< after each peck
  double shift_mm = 0;    ///< from place to place; 0: the first and the last
  double relief_mm = 0;   ///< away from the next place before the way back
};
void peck_cycle(ModalState& s, const PeckCycle& cycle);

/// G74 and G75 of system A, in two blocks, of which the first sets the retract, or one:
///
///     G74 R(retract)     G74 X Z P(shift) Q(peck) R(relief) F     G74 X Z I(shift) K(peck) F
///     G75 R(retract)     G75 X Z P(peck) Q(shift) R(relief) F     G75 X Z I(peck) K(shift) F
///
/// P and Q without a point count steps of 1 um or 0.0001 inch; P and I are radii.
/// Source: [Lathe cycles] in docs/bibliography.md.
class PeckCycleReader {
 public:
  void take(ModalState& s, int code, const Block& block);

 private:
  double retract_mm_ = 0;
};

}  // namespace turnwright::review
