#pragma once
#include <cstddef>
#include <span>
#include <string_view>

/// How the controls of turning machines write the same program: a row of words for each.
///
/// Words with names in braces are templates, for example "T{tool:02}{offset:02}"; each
/// line of a template is a block.  Arcs are the same everywhere: G2 and G3 as seen with X
/// up and Z to the right, the centre by I and K from the start, I as a radius although X
/// is a diameter.
///
/// Sources: LinuxCNC's interpreter, which runs the programs in linuxcnc_test; of the
/// others those under "Controls" in docs/bibliography.md.
namespace turnwright::gcode {

enum class Control { linuxcnc, fanuc, fanuc_b, haas, siemens_iso, siemens, okuma };

/// What the number of a tool's offset is.
enum class OffsetNumber {
  of_tool,  ///< the tool's number
  free,     ///< a register of its own, by default that of the tool's number
  edge      ///< the edge of the tool, by default the first
};

/// The lengths of feed between which a control's drilling cycle draws the drill out.
enum class PeckLaw {
  none,    ///< it does not, or how is not known
  equal,   ///< all alike, counted from where the drill begins
  reduced  ///< a first one, then shorter ones that are alike
};

struct Dialect {
  Control control;
  std::string_view id;    ///< in requests, "fanuc-b"
  std::string_view name;  ///< for people
  std::string_view extension;

  std::string_view begin;  ///< before everything else; {program} is its number
  std::string_view start;  ///< plane, units, modes, then the work offset: {offset}
  std::string_view end;
  int programs;  ///< largest number of a program, 0 if it has none
  std::span<const std::string_view> work_offsets;  ///< the first is used by default
  std::string_view reference;  ///< to the reference position, from the change of tools

  std::string_view comment;  ///< {}
  bool upper_case;           ///< the control's code has no small letters
  std::size_t longest;       ///< characters of a comment

  std::string_view tool;  ///< {tool}, {offset}
  OffsetNumber offset;

  std::string_view surface_speed;  ///< {S} in m/min below the limit {limit}, {turn}
  std::string_view thread;         ///< one cut of a thread
  char lead;                       ///< the letter of its lead
  /// The word for a thread is a cycle: in along X, cut along Z, out, and back.
  bool thread_returns;
  /// All cuts of a thread, the k-th sqrt(k) times as deep as the first; empty if unknown.
  /// From the position before the first: {X}, {Z} of the last cut's end, {lead}; from the
  /// position to the thread's outside {peak_d}, its depth {depth}, {depth_d}, {depth_um}
  /// and that of the first cut {first}, {first_d}, {first_um}, as a radius [mm], a
  /// diameter [mm] and a radius [um]; the least infeed, the last cut's, {least}, {least_um}
  /// and the number of {others}; one lead behind the position {Z_run_in}, {clear} from the
  /// thread's outside {outside_d}; {form} is 3 outside, 4 in bores.
  std::string_view thread_cycle;
  /// A tap of the lead {lead} from where it stands, {R}, to {Z} and back, the spindle in
  /// step at {S}.
  std::string_view tap;

  /// A hole on the axis in one feed, from where the drill stands and back: {Z} its bottom,
  /// {R} the place where the drill stands, {R_less_1} 1 mm on, {depth} from {R}, {feed}.
  std::string_view drill_cycle;
  /// The same with pecks, each time back to {R}: all of the length {peck}, {peck_um} of a
  /// PeckLaw::equal; otherwise the first to the place {first_Z}, {first} deep, then of the
  /// length {peck}, {less} shorter than the first, {ratio} times as long, cut off.  From
  /// {back} before the depth reached it feeds again, where it has a word for that.
  std::string_view peck_cycle;
  PeckLaw pecks;
  /// That distance [mm] where the control has it fixed, 0 where a word, a parameter or a
  /// setting of the machine gives it.
  double peck_back_mm;

  std::string_view per_minute, per_revolution;  ///< feed
  /// Words with which the main spindle becomes axis C and a spindle again, and is held and
  /// freed; the shop's own come first.  Empty: there are none, or the builder has them.
  std::string_view c_axis_on, c_axis_off, lock, unlock;
  bool c_axis_is_builders;  ///< nothing turns the part without the builder's codes
  std::string_view c_axis;  ///< to {C} degrees
  /// The driven tool at {S} 1/min, clockwise, and at rest.  Empty: the builder has them.
  std::string_view tool_on, tool_off;
  bool y_axis;  ///< Y moves as X and Z do, X staying a diameter

  bool point;           ///< a number without a point may count steps
  int decimals;         ///< of diameters and lengths
  int centre_decimals;  ///< of the centres of arcs
  int S_decimals;       ///< of spindle and surface speeds
};

std::span<const Dialect> dialects();
const Dialect& dialect(Control control);

/// A number cut off at its last decimal, with an allowance for the rounding of whole
/// numbers: a word that must not exceed it.
double cut_off(double value, int decimals);

}  // namespace turnwright::gcode
