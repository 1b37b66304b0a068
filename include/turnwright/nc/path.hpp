#pragma once
#include <functional>
#include <optional>
#include <span>
#include <vector>

/// Ways of a turning tool over a contour.
///
/// The contour lies in a plane of height h and place z: h points out of the material into
/// the air (h = radius outside, h = -radius in a bore), z along the axis towards the free
/// end.  The tool cuts towards the chuck, so a contour runs with falling z; h falls on arcs
/// alone.
namespace turnwright::nc {

struct Point {
  double h_mm = 0, z_mm = 0;
};

/// Unit normals of a contour, into the air.
struct Normal {
  double h = 0, z = 0;
};
/// Of the straight line between two points.
/// @throws std::domain_error if they are the same.
Normal normal(const Point& from, const Point& to);

/// The programmed point of a tool whose corner, of radius r, touches a contour at P.  It
/// is the imaginary tip, where the tangents of the corner parallel to both axes meet:
///
///     tip = P + r (n - (1, 1)) (1)
///
/// On lines parallel to an axis the tip is on the contour; along others it keeps the
/// corner tangent to it.
Point tip(const Point& touched, const Normal& n, double re_mm);

/// Tip where two lines of normals m and n meet in P, tangent to both,
///
///     tip = P + r ((m + n)/(1 + m n) - (1, 1)). (2)
///
/// In an inner corner the fillet of the corner's radius stays, an outer one is sharp.
Point tip(const Point& corner, const Normal& m, const Normal& n, double re_mm);

/// Tips with which a corner of radius r leaves a line that ends at `a` and meets the next,
/// which begins at `b` a little above or below.  In an inner corner, and where nothing is
/// between the two, one place that touches both lines; else two, one above the other, that
/// touch the edge of the higher line and cut into neither.
struct Crossing {
  Point leave, meet;
};
Crossing across(const Point& a, const Normal& m, const Point& b, const Normal& n,
                double re_mm);

/// Tips at the points of a straight-lined contour; by (1) at its ends, (2) between.
std::vector<Point> tips(const std::vector<Point>& contour, double re_mm);

/// A circular piece of a contour, from its free end to the chuck's.
struct Arc {
  Point from, to, centre;
  bool convex = true;  ///< the centre lies in the material
};
/// Of a radius through two points.
/// @throws std::domain_error unless R is at least half the chord (1e-9 R is forgiven).
Arc arc_through(const Point& from, const Point& to, double radius_mm, bool convex);

/// At a point of an arc.
Normal arc_normal(const Arc& arc, const Point& at);

/// The tip's way along an arc: an arc of radius R + r (convex) or R - r about a centre
/// shifted by (-r, -r), from where the corner touches one end to where it touches the other.
/// Nothing if the corner does not fit into the arc.
std::optional<Arc> tip_arc(const Arc& contour, double re_mm);

/// A straight or circular piece of a contour.
struct Piece {
  Point from, to;
  std::optional<Arc> arc;
};

double distance_mm(const Piece& piece, const Point& p);

/// A tool's corner, and its minor edge behind, towards the free end, which rises at an angle
/// and ends nowhere; none: nothing is behind it.
struct Corner {
  double re_mm = 0;
  std::optional<double> rises_rad = std::nullopt;
};

/// A way of a length: its place after s, no faster than s.
struct Course {
  double length_mm = 0;
  std::function<Point(double)> at;
};
Course along(std::vector<Point> way);
/// The shorter way round its centre.
Course around(const Arc& arc);
Course backwards(Course course);

/// How far a tip gets along a course before its tool cuts into a piece, but for 1e-6 mm: an
/// edge that it passes over does not stop it.
double free_mm(const Course& tip, std::span<const Piece> pieces, const Corner& corner);

}  // namespace turnwright::nc
