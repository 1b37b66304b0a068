#pragma once
#include <optional>
#include <vector>

#include "site.hpp"

/// The nominal contour around a pass.
namespace turnwright::nc {

/// The finished line of an element with the plan's correction; of a groove, thread or arc
/// that is cut later the line of its blank.
std::vector<Point> corrected(const Site& site, const Side& side, const Surface& s);
/// A line that ends with an undercut before the shoulder at z.
std::vector<Point> with_undercut(std::vector<Point> line, const part::Undercut& undercut,
                                 double z_mm);
/// The line of the pass that finishes an element, from the chamfer at its front to its
/// undercut.  A rounded edge is a polygon that touches it from outside.
std::vector<Point> finished_line(const Site& site, const Side& side, const Surface& s);
/// That of a pass which leaves a thickness on the nominal element: of a rounded edge it
/// leaves a chamfer.
std::vector<Point> roughed_line(const Surface& s, double left_mm);
/// Index in a finished line at which the chamfer at its front ends.
std::size_t edge_of_front(const Surface& s);
/// The way of the tip around the rounded edge at the front of a surface; none without one.
std::optional<Arc> rounding(const Site& site, const Side& side, const Surface& s,
                            double re_mm);
/// The last point of a way, from the i-th one on, that belongs to the polygon of such an arc;
/// i itself if the i-th does not.
std::size_t around_edge(const std::vector<Point>& way, std::size_t i, const Arc& arc);
/// The point of an arc that is next to another.
Point onto(const Arc& arc, const Point& p);
/// The plan's correction of a surface in the setup that finishes it; empty if none is
/// proposed.
const planning::Compensation::Table& correction(const Site& site,
                                                const std::string& surface);

const std::optional<part::Cut>& cut_of(const Site& site, const Surface& s);
/// The arc drawn on an element.
Arc drawn_arc(const Site& site, const Surface& s);

/// The nominal contour from the free end to the beginning of element k; outside, its
/// lowest height is that of the axis.
std::vector<Piece> drawn_before(const Site& site, const Side& side, std::size_t k);
/// The last of the adjoining elements from element k on; there may be a gap between bores
/// from both ends.
std::size_t end_of_run(const Side& side, std::size_t k);
/// Whether the hole continues behind bores that end at a position and height.
bool hole_goes_on(const Site& site, const Side& side, double z_mm, double h_mm);
/// The nominal contour behind element k: the adjoining elements, and the rest of the
/// hole.
std::vector<Piece> drawn_behind(const Site& site, const Side& side, std::size_t k);
/// A point further along a contour by a distance, on the line that has a normal.
Point moved_along(const Point& p, const Normal& of_line, double by_mm);
/// A wall at a position, which no tool passes.
Piece wall(double z_mm);
/// Reports in `site.cannot` if the jaws prevent a tip from going as far as the end of
/// element k requires, and no other setup removes the remaining material.
void tell_jaws(Site& site, std::size_t k, const std::string& operation,
               double needed_z_mm);

/// Whether a tool can come down to the beginning of a path and follow it without cutting
/// the nominal contour.
bool comes_in(const std::vector<Point>& way, const std::vector<Piece>& pieces,
              const Corner& corner);
/// Start of a slope of 45 deg that comes down to a position, by which the finished surface
/// in front is not touched; none if something drawn stands in its way.
std::optional<Point> slope_onto(const Point& to, double above_mm,
                                const std::vector<Piece>& pieces, const Corner& corner);

}  // namespace turnwright::nc
