#pragma once
#include <cstddef>
#include <optional>

#include "turnwright/planning/approach.hpp"
#include "turnwright/planning/setup_geometry.hpp"

/// What the passes over a surface run beside it: feed in the air, and rapids.
///
/// Heights h point out of the material, radii outside and radii less than nothing in bores;
/// z runs along the program's axis, nothing at the finished face of the free end and
/// falling towards the chuck.  A corner of radius r that touches lines inclined by a and b
/// has its tip, which is programmed, at
///
///     z_tip = z + r (sin((a + b)/2)/cos((a - b)/2) - 1).                               (1)
///
/// Source: the ways of turnwright/nc/program.hpp, of which these are the lengths.
namespace turnwright::planning {

/// Lengths of the passes of an operation.
struct Beside {
  double fed_mm = 0;    ///< at feed by all passes, in the cut or not
  double rapid_mm = 0;  ///< approaches and returns
  /// Where the first pass begins and the last one has been left: along the axis, of bores
  /// radii.
  double from_mm = 0, to_mm = 0;
};

/// An element, outer or inner, with what limits its passes.
struct Surroundings {
  bool inner = false;
  bool mirrored = false;  ///< the program's axis runs against the part's
  double stock_h = 0;     ///< of what nobody has cut, outside
  double front = 0;       ///< material before the free end
  double root_z = 0;      ///< where the jaws, or the held end, are
  double r_most = 0;      ///< largest corner of the plan's tools
  double z0 = 0, h0 = 0, z1 = 0, h1 = 0;
  bool first = false;      ///< begins at the free end
  double wall_z = 0;       ///< roughing ends here at the latest
  double shoulder_mm = 0;  ///< and so much before its end
  double touch_z = 0,
         touch_rad = 0;  ///< what the last pass runs into, and how steep it is
  /// Inclinations of the neighbours that a finishing pass goes on from and to, and how
  /// long the shorter of the two is.
  std::optional<double> before_rad = {}, behind_rad = {};
  double before_long_mm = 0, behind_long_mm = 0;
  /// The next element, if it is as high as this one: once it is cut from the other end, so
  /// is what a pass leaves here.
  std::optional<std::size_t> level_behind = {};
};
Surroundings surroundings(const PlanRequest& plan, std::size_t setup, Clamping clamping,
                          const SetupWork& work, const Element& element);

/// What a pass that makes an element needs of the axis beyond its end [mm], for a corner:
/// the corner itself, or as much less as it touches what rises behind.
double needed_beyond_mm(const Surroundings& element, double corner_mm);
/// Whether the jaws leave that.
bool clears_jaws(const Surroundings& element, double corner_mm);

/// Some passes over an element with a corner; the last pass makes what is drawn.
struct Strokes {
  int passes = 1;
  bool finishing = false;
  double corner_mm = 0;
  double left_mm = 0;  ///< mean of what stands over the element after each of them
};
Beside beside(const Surroundings& element, const Strokes& strokes);

/// Room of a thread's tool at the thread's root.
struct ThreadRoom {
  double before_mm = 0;  ///< to what stands before; a chamfer does not
  bool stands_behind = false;
};
ThreadRoom thread_room(const PreparedPart& plan, std::size_t setup, const SetupWork& work,
                       const Element& element, double root_h);

/// Revolutions of a facing tool between two radii at constant surface speed, but for a
/// factor: the spindle keeps its limit inside a diameter,
///
///     integral of max(2 |x|, D_c) dx.                                                 (2)
double swept_mm2(double from_mm, double to_mm, double D_c_mm);

/// Where tools are changed, from the surface of the stock and the free end.
struct Home {
  double x_mm = 0, z_mm = 0;
};
Home home_of(const PlanRequest& plan, double front_mm);

/// Material [mm] before the free end of a setup while what is no face is cut.
double front_mm(const PlanRequest& plan, std::size_t setup, const SetupWork& work);

}  // namespace turnwright::planning
