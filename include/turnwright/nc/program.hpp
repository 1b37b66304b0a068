#pragma once
#include <string>
#include <vector>

#include "turnwright/nc/path.hpp"
#include "turnwright/planning/process_plan.hpp"

/// Turning programs of a process plan, one for each setup.
///
/// Program zero is on the spindle's axis in the finished face of the free end, +Z away
/// from the chuck, whichever end of the part that is.  Tools are programmed at their
/// imaginary tip (path.hpp) with the control's radius compensation off (G40): the way
/// already is what the corner needs.  Blades are programmed at their corner towards the
/// chuck, drills at their point, threading tools at theirs.
///
/// Operations follow in the plan's order with its conditions.  F, S and the spindle's
/// limit are cut off, never rounded up.  Besides the plan's numbers the ways need some of
/// their own:
///
///     approach    2 mm before the surface, 1 mm above (in bores 0.2 mm), that at feed; a
///                 pass that would start in what an element before still carries starts
///                 before that element
///     corners     keep the fillet of the corner's radius r where the contour rises; a
///                 pass ends where the corner touches what is drawn behind, or r, the
///                 largest r of the plan's tools and 0.2 mm behind an edge that falls
///     cones       are roughed parallel to themselves
///     shoulders   faced by the plan: turning leaves them their stock, the facing pass
///                 runs out along the smaller element, a cone too, to where turning ended
///     faces       past the axis by r, of a hollow part past the hole by r + 0.2 mm
///     grooves     plunges side by side between the walls, the first at the chuck's
///     threads     radial infeeds, each from 3 pitches before; where the part rises
///                 behind without a groove the thread ends one pitch early
///     parting     the blade's side towards the part at the face's allowance
///     tool change X and Z 50 mm clear of the stock
///
/// Source: derived here; program_test takes the canonical moves of an interpreter and
/// lets the tools' circles pass over the contour.
namespace turnwright::nc {

/// What the control is told in its own words.
enum class Control {
  linuxcnc,  ///< spindle's limit with G96 (D), G95, G33 K, diameters by G7
  fanuc      ///< system A: G50 S, G99, G32 F, tool words of four digits
};

struct Move {
  enum class Kind { rapid, feed, arc, thread };
  Kind kind = Kind::rapid;
  double x_mm = 0, z_mm = 0;  ///< radius and place in the program
  Point centre = {};          ///< of an arc: its radius in h_mm, its place in z_mm
  bool clockwise = false;     ///< of an arc: G2, seen with X up and Z to the right
};

/// One operation of the plan, or a stop: what is milled is not in a turning program.
struct Step {
  std::vector<std::string> comments;
  bool stop = false;  ///< M0: somebody changes the clamping, or mills
  int tool = 0;
  bool constant_surface_speed = false;
  double S = 0;          ///< m/min, or 1/min
  double n_max_rpm = 0;  ///< with constant surface speed
  double f_mm_rev = 0;   ///< of a thread its pitch
  std::vector<Move> moves;
};

struct TableTool {
  int number = 0;
  std::string id;
  double re_mm = 0;     ///< corner radius, 0 of blades, drills and threading tools
  int orientation = 0;  ///< of the tip: 3 outside, 2 in a bore, 7 drills
};

struct SetupProgram {
  std::size_t setup = 0;
  std::vector<std::string> comments;
  std::vector<TableTool> tools;
  std::vector<Step> steps;
};

struct Programs {
  std::vector<SetupProgram> setups;  ///< none of an infeasible plan
  /// Sentences on what would be cut wrong or cannot be reached (docs/nc.md lists what);
  /// then `setups` is empty.
  std::vector<std::string> cannot;
};

/// The ways of every setup of a plan.
Programs programs(const planning::PreparedPart& part, const planning::ProcessPlan& plan);

/// The program's text, lines of printable ASCII.
std::string text(const SetupProgram& program, Control control);

/// LinuxCNC's tool table for programs of one part: numbers, diameters and orientations,
/// offsets zero.
std::string tool_table(const std::vector<SetupProgram>& programs);

}  // namespace turnwright::nc
