#pragma once
#include <functional>
#include <optional>
#include <span>
#include <vector>

/// Paths of a turning tool over a contour.
///
/// The contour lies in a plane with the coordinates h and z: h points out of the material
/// into the air (h = radius outside, h = -radius in a bore), z along the axis towards the
/// free end.  The tool cuts towards the chuck, so z falls along a contour; h falls only
/// on arcs.
namespace turnwright::toolpath {

struct Point {
  double h_mm = 0, z_mm = 0;
};

/// A unit normal of a contour, pointing into the air.
struct Normal {
  double h = 0, z = 0;
};
/// The normal of the straight line between two points.
/// @throws std::domain_error if the points are equal.
Normal normal(const Point& from, const Point& to);

/// The programmed point of a tool whose corner, of radius r, touches a contour at P.  It
/// is the imaginary tip, where the tangents of the corner parallel to both axes meet:
///
///     tip = P + r (n - (1, 1)) (1)
///
/// On lines parallel to an axis the tip is on the contour; on other lines the corner
/// stays tangent to the contour.
Point tip(const Point& touched, const Normal& n, double re_mm);

/// Tip of a corner that is tangent to both of two lines, with normals m and n, that meet
/// in P:
///
///     tip = P + r ((m + n)/(1 + m n) - (1, 1)). (2)
///
/// In an inner corner of the contour the fillet of the tool's radius stays; an outer
/// corner becomes sharp.
Point tip(const Point& corner, const Normal& m, const Normal& n, double re_mm);

/// Tips at which a corner of radius r leaves a line that ends at `a` and meets the next
/// line, which begins at `b` slightly above or below.  In an inner corner, and where
/// there is no step, both are one position that touches both lines.  Otherwise they are
/// two positions, one above the other, that touch the edge of the higher line and cut
/// into neither.
struct Crossing {
  Point leave, meet;
};
Crossing across(const Point& a, const Normal& m, const Point& b, const Normal& n,
                double re_mm);

/// Tips at the points of a contour of straight lines, by (1) at its ends and (2) between.
std::vector<Point> tips(const std::vector<Point>& contour, double re_mm);

/// A circular piece of a contour, from its end towards the free end to that towards the
/// chuck.
struct Arc {
  Point from, to, centre;
  bool convex = true;  ///< the centre lies in the material
};
/// The arc of a given radius through two points.
/// @throws std::domain_error unless R is at least half the chord, up to 1e-9 R.
Arc arc_through(const Point& from, const Point& to, double radius_mm, bool convex);

/// The normal at a point of an arc.
Normal arc_normal(const Arc& arc, const Point& at);

/// Path of the tip along an arc: an arc of radius R + r (convex) or R - r about a centre
/// shifted by (-r, -r), between the positions in which the corner touches its ends.
/// Nothing if the corner does not fit into the arc.
std::optional<Arc> tip_arc(const Arc& contour, double re_mm);

/// A straight or circular piece of a contour.
struct Piece {
  Point from, to;
  std::optional<Arc> arc;
};

double distance_mm(const Piece& piece, const Point& p);

/// A tool's corner and its minor edge, which rises at an angle behind the corner, towards
/// the free end, without end; if there is no angle the tool has no minor edge.
struct Corner {
  double re_mm = 0;
  std::optional<double> rises_rad = std::nullopt;
};

/// A path of a given length: the position after the distance s along it, which changes by
/// at most the change of s.
struct Course {
  double length_mm = 0;
  std::function<Point(double)> at;
};
Course along(std::vector<Point> way);
/// The path along an arc, the shorter way round its centre.
Course around(const Arc& arc);
Course backwards(Course course);

/// Distance that a tip can move along a course before its tool cuts into a piece by more
/// than 1e-6 mm, so that an edge that the tool just touches does not stop it.
double free_mm(const Course& tip, std::span<const Piece> pieces, const Corner& corner);

}  // namespace turnwright::toolpath
