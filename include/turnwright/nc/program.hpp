#pragma once
#include <string>
#include <vector>

#include "turnwright/nc/path.hpp"
#include "turnwright/planning/prepared_part.hpp"
#include "turnwright/planning/process_plan.hpp"

/// Turning programs of a process plan, one for each setup.
///
/// Program zero is on the spindle's axis in the finished face of the free end, +Z away
/// from the chuck, whichever end of the part that is.  Tools are programmed at their
/// imaginary tip (path.hpp) with the control's radius compensation off (G40): the path
/// already allows for the corner.  Blades are programmed at their corner towards the
/// chuck, drills at their point, threading tools at theirs.
///
/// Operations follow in the plan's order with its conditions.  F, S and the spindle's
/// limit are cut off, never rounded up.  The paths need some rules in addition to the
/// plan's numbers:
///
///     approach    2 mm before the surface, 1 mm above (in bores 0.2 mm), the last part
///                 at feed; a pass that would start in the stock left on an element in
///                 front comes down through it on a slope that the minor edge clears, or
///                 starts in front of an element too short for that
///     corners     keep the fillet of the corner's radius r where the contour rises; a
///                 pass ends where the corner touches the drawn contour behind, or r, the
///                 largest r of the plan's tools and 0.2 mm behind an edge that falls
///     cones       are roughed parallel to themselves, as far as the stock reaches
///     walls       roughing ends the least depth of the finishing tool before them, and
///                 draws out along them as far as the pass was deep, so that no wedge of
///                 the lead angle stays; finishing runs along the whole contour, up its
///                 walls, and draws out to the top of the last one
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
/// moves the tools' circles over the contour.
namespace turnwright::nc {

struct Move {
  enum class Kind { rapid, feed, arc, thread };
  Kind kind = Kind::rapid;
  double x_mm = 0, z_mm = 0;  ///< radius and place in the program
  Point centre = {};          ///< of an arc: its radius in h_mm, its place in z_mm
  bool clockwise = false;     ///< of an arc: G2, seen with X up and Z to the right
  /// Over the stock that roughing has left on elements in front.
  bool entering = false;
};

/// The range in which a tool is in the cut: along the axis, or between two radii.
struct InCut {
  bool across = false;            ///< between radii
  double from_mm = 0, to_mm = 0;  ///< from < to, in the program's own coordinates
};

/// One operation of the plan, or a stop.  Milling is not part of a turning program.
struct Step {
  std::vector<std::string> comments;
  bool stop = false;    ///< M0: somebody changes the clamping, or mills
  double stop_min = 0;  ///< its duration; 0 for milling
  int tool = 0;
  bool constant_surface_speed = false;
  double S = 0;          ///< m/min, or 1/min
  double n_max_rpm = 0;  ///< with constant surface speed
  double f_mm_rev = 0;   ///< of a thread its pitch
  InCut in_cut;
  std::vector<Move> moves;
};

inline constexpr int kDrillOrientation = 7;

struct TableTool {
  int number = 0;
  std::string id;
  int offset = 0;       ///< number of its offset
  double re_mm = 0;     ///< corner radius, 0 of blades, drills and threading tools
  int orientation = 0;  ///< of the tip: 3 outside, 2 in a bore, or of drills
};

/// Minutes that a program runs or waits, without loading and preparing the machine.
struct Minutes {
  double cutting = 0;         ///< feed over the surface that an operation makes
  double air = 0;             ///< feed beside it, and rapids
  double entering = 0;        ///< part of `air` over stock in front; not in planned times
  double tool_changes = 0;    ///< the moves to the tool change position are in `air`
  double operator_stops = 0;  ///< M0 for changes of the clamping
  double total() const { return cutting + air + tool_changes + operator_stops; }
};

struct SetupProgram {
  std::size_t setup = 0;
  std::vector<std::string> comments;
  std::vector<TableTool> tools;
  double change_x_mm = 0, change_z_mm = 0;  ///< radius and place where tools are changed
  std::vector<Step> steps;
  Minutes minutes;
};

/// Minutes of a program's own moves.  Feed per revolution at a constant surface speed v
/// below the spindle's limit n_cap takes
///
///     t = integral of ds/(f n),  n = min(n_cap, 1000 v/(2 pi |x|)),                  (1)
///
/// exactly over cylinders, cones and faces; at a constant spindle speed s/(f n).  A rapid
/// takes its longer axis at the machine's rapid rate, another tool the machine's time to
/// bring one in, the first included.  Source: derived here; time_test integrates
/// numerically.
Minutes minutes(const SetupProgram& program, const catalogue::Lathe& machine);

struct Programs {
  std::vector<SetupProgram> setups;  ///< empty for an infeasible plan
  /// Sentences on surfaces that would be cut wrong or cannot be reached (docs/nc.md lists
  /// the cases); `setups` is then empty.
  std::vector<std::string> cannot;
};

/// The programs of every setup of a plan.
Programs programs(const planning::PreparedPart& part, const planning::ProcessPlan& plan);

/// Makes a plan infeasible if it cannot be programmed; its conflicts give the reasons.  A
/// plan whose request itself turns from the chuck outwards is not changed.
void refuse_unprogrammed(const planning::PreparedPart& part, planning::ProcessPlan& plan);

}  // namespace turnwright::nc
