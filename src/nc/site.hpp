#pragma once
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "planning/clamping/jaws.hpp"
#include "planning/clamping/made_surfaces.hpp"
#include "planning/clamping/positions.hpp"
#include "planning/paths/approach.hpp"
#include "turnwright/planning/process_plan.hpp"
#include "turnwright/toolpath/setup_program.hpp"

/// A setup while it is programmed: the part in the machine, in the program's own
/// coordinates, and the position of the tool.
namespace turnwright::nc {

using namespace toolpath;

using planning::kAbove_mm;
using planning::kAboveBore_mm;
using planning::kBefore_mm;
using planning::kBehind_mm;
using planning::kChange_mm;
using planning::kClear_mm;
using planning::kPeck_mm;
inline constexpr double kSame_mm = 1e-9;    ///< heights are the same
inline constexpr double kStands_mm = 0.01;  ///< more than corrections differ

/// An element as the tool meets it, from z0 down to z1 < z0.  Its heights are those of its
/// blank; once a groove is cut into it, those of the groove's floor.
struct Surface {
  std::string id;
  bool inner = false;
  std::size_t index = 0;  ///< in the drawing
  double z0 = 0, h0 = 0, z1 = 0, h1 = 0;
  bool stock = true;   ///< not cut yet
  double stock_h = 0;  ///< outside: largest height of the uncut stock there
  double left = 0;     ///< that the last pass has left above its nominal line
  std::optional<part::Chamfer> front = {}, back = {};  ///< chamfers, drawn at z0 and z1
  /// Before the wall at z1: cut by the last pass, or by the facing of the wall.
  std::optional<part::Undercut> undercut = {}, faced_undercut = {};
  bool finished = false;  ///< has its drawn contour
};

/// Outside or in the bores.
struct Side {
  double sign = 1;             ///< h = sign x
  double stock_h = 0;          ///< largest height of the uncut stock
  std::vector<Surface> items;  ///< from the free end inwards

  double stock_over(const Surface& s) const { return s.inner ? stock_h : s.stock_h; }
  double top0(const Surface& s) const { return s.stock ? stock_over(s) : s.h0 + s.left; }
  double top1(const Surface& s) const { return s.stock ? stock_over(s) : s.h1 + s.left; }
  double top(const Surface& s) const;
  /// Largest height of the surfaces that lie, at least in part, between two positions on
  /// the axis, from_z < to_z; -infinity if there are none.
  double highest(double from_z, double to_z) const;
};

inline constexpr std::size_t kMostMoves = 200'000;  ///< of a setup's program

/// Thrown where a setup's program would have more than kMostMoves moves.
struct TooManyMoves {};

class Site {
 public:
  Site(const planning::PreparedPart& part, const planning::ProcessPlan& plan,
       std::size_t setup);

  const planning::PreparedPart& part;
  const planning::ProcessPlan& plan;
  std::size_t setup;
  planning::Clamping clamping;
  double sign, free_z;  ///< z of the program = sign (z of the part - free_z)
  double root_z;        ///< end of the jaws, or the held end
  double front = 0;     ///< material before the free end
  double r_most = 0;    ///< largest corner of the plan's tools
  Side outer, inner;
  std::vector<std::string> cannot;
  /// Adds to `cannot` why an operation of this setup is not programmed.
  void refuse(const std::string& operation, const std::string& why);

  const planning::SetupPlan& answer() const { return plan.setups[setup]; }
  double z(double part_z) const { return sign * (part_z - free_z); }
  Side& side(bool bore) { return bore ? inner : outer; }

  // The tool's path.
  std::vector<Move> moves;
  std::optional<Pecks> pecks;  ///< of the operation's drill
  Point at;                    ///< x, z of the tool
  void to(Move::Kind kind, const Side& side, const Point& p);
  void rapid(double x_mm, double z_mm);
  /// Around a centre, which lies in the material if the arc is convex; `inwards` from the
  /// free end towards the chuck.
  void arc(const Side& side, const Point& end, const Point& centre, bool convex,
           bool inwards);
  /// Moves from any position to above a point, clear of the material with the whole
  /// corner, then at feed onto it.
  void approach(const Side& side, const Point& p, double re_mm);
  /// The same to the start of a pass whose first move ends at `next`: where that comes
  /// down from half as high as tools come in or more, the start is reached in rapid.
  void approach(const Side& side, const Point& p, const Point& next, double re_mm);
  /// The same where nothing stands higher than the point.
  void approach_level(const Side& side, const Point& p);
  /// Moves from any position to a point outside the material.
  void approach(const Side& side, const Point& p);
  /// Moves away from the wall of a bore, as far as narrower bores in front require.
  void clear_bore();
  /// Lifts the tool off a surface and out of a corner.
  void lift(const Side& side);
  /// Moves to the tool change position.
  void home(bool inner_first);
  double above(const Side& side) const {
    return side.sign > 0 ? kAbove_mm : kAboveBore_mm;
  }

 private:
  void add(const Move& move);

  std::size_t moved_ = 0;  // moves of all operations so far
};

/// The element with an id in its present state.
/// @throws std::domain_error if there is none.
const Surface& surface_of(const Site& site, const std::string& id);

/// Distance [mm] of the programmed surface from the drawn one, without a corrected path: to
/// the middle of the size's limits, plus the tool offset that the plan gives there.  It
/// counts on the radius; of a face, along the part's axis.
double moved_mm(const Site& site, const std::string& surface);
/// Distance of an element's height in the middle of its size's limits from the drawn one.
double middle_h(const part::Drawing& drawing, const Side& side, const Surface& element);

}  // namespace turnwright::nc
