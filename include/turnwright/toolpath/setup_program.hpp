#pragma once
#include <optional>
#include <string>
#include <vector>

#include "turnwright/catalogue/machine.hpp"
#include "turnwright/toolpath/path.hpp"

/// A turning program of one setup: tools, steps and moves, before a control's words.
namespace turnwright::toolpath {

struct Move {
  /// A thread on the axis is tapped: in, and back with the spindle reversed.
  enum class Kind { rapid, feed, arc, thread };
  Kind kind = Kind::rapid;
  double x_mm = 0, z_mm = 0;  ///< radius and place in the program
  Point centre = {};          ///< of an arc: its radius in h_mm, its place in z_mm
  bool clockwise = false;     ///< of an arc: G2, seen with X up and Z to the right
  /// Over the stock that roughing has left on elements in front.
  bool entering = false;
  double y_mm = 0;        ///< of a milling cutter beside the spindle's axis
  double feed_share = 1;  ///< of the operation's feed
};

/// The range in which a tool is in the cut: along the axis, or between two radii.
struct InCut {
  bool across = false;            ///< between radii
  double from_mm = 0, to_mm = 0;  ///< from < to, in the program's own coordinates
};

/// The longest that a drill goes at feed before it has to be drawn out of its hole.
struct Pecks {
  double first_mm = 0;  ///< from the surface
  double step_mm = 0;   ///< from the depth reached
};

/// Milling by a driven tool that stands across the part, which the main spindle holds at
/// an angle.  Moves are those of the middle of the cutter's end.
struct Milling {
  double n_rpm = 0, f_mm_min = 0;  ///< of the cutter
  double C_deg = 0;                ///< where the main spindle holds the part
  bool needs_y = false;            ///< the cutter leaves the plane of the spindle's axis
  std::string stop = {};           ///< what a program says that stops here instead
};

/// One operation of the plan, or a stop.
struct Step {
  std::vector<std::string> comments;
  bool stop = false;    ///< M0: somebody changes the clamping, or mills
  double stop_min = 0;  ///< its duration; 0 where somebody mills
  int tool = 0;
  bool constant_surface_speed = false;
  double S = 0;          ///< m/min, or 1/min
  double n_max_rpm = 0;  ///< with constant surface speed
  double f_mm_rev = 0;   ///< of a thread its pitch
  InCut in_cut;
  std::vector<Move> moves;
  std::optional<Milling> milling = {};
  std::optional<Pecks> pecks = {};  ///< of a drill that is drawn out to clear its chips
};

inline constexpr int kDrillOrientation = 7, kCutterOrientation = 0;

struct TableTool {
  int number = 0;
  std::string id;
  int offset = 0;    ///< number of its offset
  double re_mm = 0;  ///< corner radius, 0 of blades, drills, cutters and threading tools
  int orientation = 0;  ///< of the tip: 3 outside, 2 in a bore, or of tools on the axis
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
/// exactly over cylinders, cones and faces; at a constant spindle speed s/(f n), of a
/// milling cutter s/f.  A rapid
/// takes its longer axis at the machine's rapid rate, another tool the machine's time to
/// bring one in, the first included.  Source: derived here; time_test integrates
/// numerically.
Minutes minutes(const SetupProgram& program, const catalogue::Lathe& machine);

/// Minutes of one move by the same rules, at the conditions of its step.
double move_min(const Step& step, const Move& from, const Move& to,
                const catalogue::Lathe& machine);

}  // namespace turnwright::toolpath
