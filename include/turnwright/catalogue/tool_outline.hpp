#pragma once
#include <vector>

#include "turnwright/catalogue/tool.hpp"

/// Outlines of turning tools, insert and holder, in the plane through the part's axis.
///
/// The coordinates are those of the tool: the origin is its imaginary tip, where the
/// tangents of the corner parallel to both axes meet; h points out of the material into
/// the air (outside h = x, in a bore h = -x), z along the axis towards the free end.  The
/// tool cuts towards -z.  A boring bar is thus the mirror image of an external tool.
namespace turnwright::catalogue {

struct OutlinePoint {
  double h_mm = 0, z_mm = 0;
};
/// A convex polygon, clockwise seen with h up and z to the right.
using ConvexOutline = std::vector<OutlinePoint>;

struct ToolOutline {
  double re_mm = 0;  ///< of the corner, whose centre is (re, re)
  /// The insert with sharp corners.  It begins at the cutting corner and follows the major
  /// edge; its last side is the minor edge.  A round insert has none: it is the circle of
  /// the corner.
  ConvexOutline insert;
  std::vector<ConvexOutline> holder;  ///< none if the tool's document has no holder
};

/// Clearance [mm] of a holder behind the lines of both cutting edges: the insert stands
/// out over its seat.  An estimate; standards leave it to makers.
inline constexpr double kSeatBehind_mm = 0.5;

/// The outline of a tool.  With kappa = KAPR and the included angle eps of the insert's
/// shape, the edges lie in the directions
///
///     major (sin kappa, -cos kappa), minor (sin kappa', cos kappa') in (h, z),      (1)
///     kappa' = 180 deg - kappa - eps,                                               (2)
///
/// from the sharp corner at (re, re) - re (major + minor)/sin(eps).  The other corners
/// follow from the sides' length and the angles of the shape.
///
/// The head of an external holder fills the room between the tip and LH, as far as its
/// shank is wide, that lies `kSeatBehind_mm` behind the lines of both edges: what ISO 5610
/// leaves it, no maker's is larger.  The shank goes on to LF.  A boring bar is its
/// segments about its axis, up to the line of the major edge.
/// Source: ISO 1832 shapes; (1), (2) derived here, tool_outline_test has closed forms.
/// @throws std::domain_error if the insert's designation cannot be read.
ToolOutline outline(const Tool& tool);

/// Angle kappa' [deg] between the minor edge and the axis by (2); round
/// inserts have none.
std::optional<double> minor_angle_deg(double kapr_deg, const Insert1832& insert);

/// An outline with its corners rounded, as polygon: chords of each arc are within
/// `chord_mm` of it, inside.  Of a round insert the circle.
ConvexOutline rounded_insert(const ToolOutline& outline, double chord_mm);

}  // namespace turnwright::catalogue
