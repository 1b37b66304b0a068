#pragma once
#include <functional>
#include <optional>
#include <vector>

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

/// A hole on the axis from where the tool stands: to `from_z_mm` at rapid, then stroke by
/// stroke, and away.
struct DrillCycle {
  double from_z_mm = 0, away_z_mm = 0;
  std::vector<double> strokes_z_mm = {};  ///< their ends, the last is the bottom
  /// After each stroke but the last: out to where it began and back to this distance before
  /// the depth reached, or back by a retract alone.
  bool clears = true;
  double before_mm = 0, retract_mm = 0;
  double first_feed_share = 1;
  double wait_bottom_min = 0, wait_top_min = 0;
  double feed_out = 0;      ///< of the way out, in the control's unit; 0: at rapid
  bool feeds_away = false;  ///< the whole way, not only to where the strokes begin
};
void drill_cycle(ModalState& s, const DrillCycle& cycle);

/// Ends of strokes from a place to the bottom, of which each is `next` of the one before;
/// empty beyond 200 of them, or where one is not longer than 0.
std::vector<double> strokes(double from_z_mm, double bottom_z_mm, double first_mm,
                            const std::function<double(double before_mm)>& next);

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
