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

}  // namespace turnwright::review
