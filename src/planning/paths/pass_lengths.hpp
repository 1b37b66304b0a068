#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "approach.hpp"
#include "planning/clamping/made_surfaces.hpp"

/// Lengths that the passes over a surface move outside it: feed in the air, and rapids.
///
/// Heights h point out of the material: radii outside, negative radii in bores.  z runs
/// along the program's axis, is 0 at the finished face of the free end and falls towards
/// the chuck.  A corner of radius r that touches lines inclined by a and b
/// has its tip, which is programmed, at
///
///     z_tip = z + r (sin((a + b)/2)/cos((a - b)/2) - 1).                             (1)
///
/// Source: these are the lengths of the tool paths described in
/// turnwright/nc/program.hpp.
namespace turnwright::planning {

/// Lengths of the passes of an operation.
struct Beside {
  double fed_mm = 0;    ///< at feed by all passes, in the cut or not
  double wall_mm = 0;   ///< of it, drawn out along walls
  double rapid_mm = 0;  ///< approaches and returns
  /// Positions where the first pass begins and where the tool has left the last one:
  /// along the axis, for bores radii.
  double from_mm = 0, to_mm = 0;
};

/// Where finishing may run on from an element to the next one without leaving the contour:
/// they are drawn as high where they meet, or the next one stands behind a wall.
struct Passage {
  bool cylinders = true;  ///< both are
  double least_mm = 0;    ///< the smaller of their lengths
  double falls_mm = 0;    ///< step down between the middles of their limits
  double rad = 0;         ///< inclination of the neighbour, or of the wall
  std::optional<double> wall_to_h = {};  ///< height of the wall, if there is one
};
/// Whether a corner of this radius with a minor edge of this angle runs on there.  Cones
/// that are short may lie in the fillets at their ends, and down from them the minor edge
/// leaves no way.
bool runs_on(const Passage& passage, double corner_mm, double minor_rad);

/// The outline of a casting or forging over an outer element and where its passes run out,
/// in the order of the passes; empty of other stock and of cones.
struct Outline {
  struct Line {
    double z0 = 0, h0 = 0, z1 = 0, h1 = 0;
  };
  std::vector<Line> lines;
  double front_z = 0;              ///< of the element
  double drawn_h = 0, most_h = 0;  ///< of the element, and of its stock
};
Outline outline_over(const PreparedPart& plan, std::size_t setup, std::size_t element);
/// Where the i-th of n passes comes to the first stock that stands above what it would
/// leave if the passes shared the stock equally; nothing if that is at its front.
std::optional<double> reaches_stock_z(const Outline& outline, int i, int n);

/// An outer or inner element with everything that limits its passes.
struct Surroundings {
  bool inner = false;
  bool mirrored = false;  ///< the program's axis runs against the part's
  double stock_h = 0;     ///< largest height of the uncut stock, outside
  Outline outline;
  double front = 0;   ///< material before the free end
  double root_z = 0;  ///< where the jaws, or the held end, are
  double r_most = 0;  ///< largest corner of the plan's tools
  double z0 = 0, h0 = 0, z1 = 0, h1 = 0;
  part::Chamfer front_chamfer = {};  ///< with which every pass begins
  /// On the edge of the wall behind, which this setup's tool cuts after the wall, because
  /// another setup makes the element there; with the height at which it begins.
  part::Chamfer wall_chamfer = {};
  double wall_edge_h = 0;
  bool wall_in_stock = false;  ///< that setup comes later
  /// Before that wall: cut by the last pass, or by the operation that faces the wall.
  std::optional<part::Undercut> undercut = {}, faced_undercut = {};
  std::optional<double> fillet_mm = {};  ///< largest that may stay at the wall's foot
  /// Height of that wall below its rounded edge, which a larger corner cannot reach.
  std::optional<double> below_rounding_mm = {};
  bool first = false;       ///< begins at the free end
  double wall_z = 0;        ///< a rising surface, where roughing ends at the latest
  bool wall_steps = false;  ///< it is a wall
  double wall_h = 0;        ///< its height when this element is roughed,
  double wall_drawn_h = 0;  ///< and as finishing draws it
  double shoulder_mm = 0;   ///< stock on that wall which a facing operation takes off
  double touch_z = 0,
         touch_rad = 0;  ///< the surface that ends the last pass, and its inclination
  /// From and to the neighbours that the same setup makes.
  std::optional<Passage> before = {}, behind = {};
  /// Inclination of the neighbour in front that is drawn as high where they meet.
  std::optional<double> front_rad = {};
  /// Step down from that neighbour, where both sizes lie in the middles of different
  /// limits.
  double front_falls_mm = 0;
  /// The next element if it has the same height: the setup that cuts it from the other
  /// end also removes the remainder that a pass leaves here.
  std::optional<std::size_t> level_behind = {};
};
Surroundings surroundings(const PreparedPart& plan, std::size_t setup, Clamping clamping,
                          const SetupWork& work, const Element& element);
/// Those of all outer elements at once, in the drawing's order.
std::vector<Surroundings> outer_surroundings(const PreparedPart& plan, std::size_t setup,
                                             Clamping clamping, const SetupWork& work);

/// Length [mm] along the edge of the wall behind, `wall_chamfer`, of which what lies in stock
/// replaces a piece of wall; of a rounded edge, where the tip begins below it, a corner's
/// radius does so in any case.
double edge_mm(const Surroundings& element, double corner_mm);

/// Length [mm] beyond the end of an element that the pass which makes it needs: the
/// corner radius, or less where the corner touches a rising surface behind before that.
double needed_beyond_mm(const Surroundings& element, double corner_mm);
/// Whether the jaws leave that length free.
bool clears_jaws(const Surroundings& element, double corner_mm);

/// Passes over an element with one corner radius.
struct Strokes {
  int passes = 1;
  bool finishing = false;  ///< the last one makes the surface
  bool contour = false;    ///< it runs on into the neighbours
  double corner_mm = 0;
  double minor_rad = 0;      ///< angle at which the minor edge rises behind the corner
  double depth_mm = 0;       ///< of each pass
  double left_mm = 0;        ///< mean thickness of the stock left after each of them
  double limited_mm = 0;     ///< diameter inside which the spindle keeps its limit
  double wall_stock_mm = 0;  ///< that roughing leaves on walls for finishing
  bool in_stock = false;     ///< the first one is the first over the element
};
Beside beside(const Surroundings& element, const Strokes& strokes);

/// Room of a thread's tool at the thread's root.  What rises to the thread in front, like
/// a chamfer, is cut by the run-in, which begins before it.
struct ThreadRoom {
  double before_mm = 0;  ///< to the nearest higher surface in front
  double rising_mm = 0;  ///< length of what rises to the thread above its root
  bool stands_behind = false;
};
ThreadRoom thread_room(const PreparedPart& plan, std::size_t setup,
                       const Element& element, double root_h);
/// Way of a thread's tool before the thread: three pitches, or what the room allows; none
/// if that is less than least_run_in_mm, or if more than three pitches rise to the thread.
std::optional<double> run_in_mm(const ThreadRoom& room, double pitch_mm);
/// A pitch, and half a pitch more than what rises to the thread.
double least_run_in_mm(const ThreadRoom& room, double pitch_mm);
inline constexpr double kRunInPitches = 3;

/// Where the edge towards the chuck of a knurling wheel begins and ends on an element from
/// z0 to z1 [mm].  It begins with half the wheel on the element, or with all of it where
/// something higher than the root is in front; before what stands behind it stops by
/// kBehind_mm.  Nothing if the wheel has no room.
struct KnurlWay {
  double from_mm = 0, to_mm = 0;
};
std::optional<KnurlWay> knurl_way(const ThreadRoom& room, double z0_mm, double z1_mm,
                                  double width_mm);

/// Revolutions of a facing tool between two radii at constant surface speed, up to a
/// factor; inside the diameter D_c the spindle runs at its limit,
///
///     integral of max(2 |x|, D_c) dx.                                                (2)
double swept_mm2(double from_mm, double to_mm, double D_c_mm);

/// Position where tools are changed: a radius, and z from the finished free end.
struct Home {
  double x_mm = 0, z_mm = 0;
};
Home home_of(const PreparedPart& plan, double front_mm);

/// Material [mm] before the free end of a setup while surfaces other than its face are
/// cut.
double front_mm(const PreparedPart& plan, std::size_t setup, const SetupWork& work);

}  // namespace turnwright::planning
