#pragma once
#include <string>
#include <vector>

#include "turnwright/nc/program.hpp"
#include "turnwright/planning/setup_geometry.hpp"

/// A setup while it is programmed: what stands in the machine, in the program's own
/// coordinates, and where the tool is.
namespace turnwright::nc {

inline constexpr double kBefore_mm = 2;       ///< a pass starts so far before its surface
inline constexpr double kAbove_mm = 1;        ///< and comes in from so far above
inline constexpr double kAboveBore_mm = 0.2;  ///< in a bore
inline constexpr double kBehind_mm = 0.2;   ///< a pass ends so far behind a falling edge
inline constexpr double kClear_mm = 2;      ///< rapids along the axis above the stock
inline constexpr double kChange_mm = 50;    ///< from the stock, where tools are changed
inline constexpr double kSame_mm = 1e-9;    ///< heights are the same
inline constexpr double kStands_mm = 0.01;  ///< more than corrections differ

/// An element in the tool's order: z0 > z1, heights of its blank, or once it is cut there
/// of what is drawn, in the middle of its size's limits and with the plan's offset.
struct Surface {
  std::string id;
  bool inner = false;
  std::size_t index = 0;  ///< in the drawing
  double z0 = 0, h0 = 0, z1 = 0, h1 = 0;
  bool stock = true;  ///< nothing has been taken off yet
  double left = 0;    ///< what a pass has left on it
};

/// Outside or in the bores.
struct Side {
  double sign = 1;             ///< h = sign x
  double stock_h = 0;          ///< of what nobody has cut
  std::vector<Surface> items;  ///< from the free end inwards

  double top0(const Surface& s) const { return s.stock ? stock_h : s.h0 + s.left; }
  double top1(const Surface& s) const { return s.stock ? stock_h : s.h1 + s.left; }
  double top(const Surface& s) const;
  /// Of what stands over a stretch of the axis.
  double highest(double from_z, double to_z) const;
};

/// The offset that the plan gives the tool at a surface; 0 if none.
double offset_mm(const planning::ProcessPlan& plan, const std::string& surface);

class Site {
 public:
  Site(const planning::PreparedPart& part, const planning::ProcessPlan& plan,
       std::size_t setup);

  const planning::PreparedPart& part;
  const planning::ProcessPlan& plan;
  std::size_t setup;
  planning::Clamping clamping;
  double sign, free_z;  ///< z of the program = sign (z of the part - free_z)
  double root_z;        ///< where jaws, or the held end, are
  double front = 0;     ///< material before the free end
  double r_most = 0;    ///< largest corner of the plan's tools
  Side outer, inner;
  std::vector<std::string> cannot;

  const planning::SetupPlan& answer() const { return plan.setups[setup]; }
  double z(double part_z) const { return sign * (part_z - free_z); }
  Side& side(bool bore) { return bore ? inner : outer; }

  // The tool's ways.
  std::vector<Move> moves;
  Point at;  ///< x, z of the tool
  void to(Move::Kind kind, const Side& side, const Point& p);
  void rapid(double x_mm, double z_mm);
  /// From wherever it is to a point over what stands there, its own corner clear, then at
  /// feed onto it.
  void approach(const Side& side, const Point& p, double re_mm);
  /// From wherever it is to a point in the air.
  void approach(const Side& side, const Point& p);
  /// Off a surface and out of a corner.
  void lift(const Side& side);
  /// To the place of tool change.
  void home(bool inner_first);
  double above(const Side& side) const {
    return side.sign > 0 ? kAbove_mm : kAboveBore_mm;
  }
};

}  // namespace turnwright::nc
