#pragma once
#include <optional>
#include <vector>

#include "turnwright/nc/program.hpp"

/// Material that a program takes off, on rings around the spindle's axis.
namespace turnwright::report {

/// What of a tool meets the work, from its programmed point.
struct Cutter {
  enum class Shape {
    corner,  ///< a corner of radius r and the edge behind it, outside
    bore,    ///< the same in a bore
    face,    ///< a corner that leaves nothing in front of it, of an end face
    blade,   ///< straight, of a width, outside
    bore_blade,
    drill,   ///< on the axis, of a radius and a point angle
    nothing  ///< a thread's tool, whose grooves are not drawn
  };
  Shape shape = Shape::nothing;
  double size_mm = 0;         ///< corner radius, width of a blade, radius of a drill
  double half_point_rad = 0;  ///< of a drill
};

/// Material at one place along the axis: between two radii; none if inner >= outer.
struct Ring {
  double inner_mm = 0, outer_mm = 0;
  bool empty() const { return !(inner_mm < outer_mm); }
  bool operator==(const Ring&) const = default;
};

/// The work as rings at equal distances, in the coordinates of a program.
struct Work {
  double from_z = 0, step = 0;
  std::vector<Ring> rings;
  double z(std::size_t i) const { return from_z + static_cast<double>(i) * step; }
};

/// Takes off what a tool meets on a straight way, exactly at each ring: the height of
/// the work falls to the least of
///
///     x(s) + g(z - z(s)),  0 <= s <= 1,                                              (1)
///
/// g the profile of the tool above its programmed point: a circle and behind it a straight
/// edge that rises at 30 degrees, a level blade, a cone.  (1) is convex in s.  In a bore
/// heights count downwards.  Source: derived here; removal_test compares areas with
/// closed forms.
void take_off(Work& work, const Cutter& cutter, const toolpath::Point& from,
              const toolpath::Point& to);

/// The points to which a move goes from `from`: its end, of an arc those of its chords.
std::vector<toolpath::Point> way(const toolpath::Point& from, const toolpath::Move& move);

/// The same along any move; an arc as chords.
void take_off(Work& work, const Cutter& cutter, const toolpath::Point& from,
              const toolpath::Move& move);

}  // namespace turnwright::report
