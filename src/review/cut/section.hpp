#pragma once
#include <cstddef>
#include <functional>
#include <vector>

/// Half sections of turned bodies on two families of parallel lines, columns at fixed
/// places along the axis and rows at fixed radii.  What a convex polygon that is swept
/// along a straight way takes off a line is an interval, exact but for rounding; between
/// two lines nothing is known.  A corner of 0.2 mm that cuts 1e-4 mm too deep does so over
/// 0.013 mm, more than the distance of lines.  (Differences of polygons by Boost.Geometry
/// leave the same areas, but take nine times as long.)
namespace turnwright::review {

/// A point of a half section: its radius and its place along the axis.
struct Spot {
  double x = 0, z = 0;
};
using Polygon = std::vector<Spot>;

Spot operator+(const Spot& a, const Spot& b);
Spot operator-(const Spot& a, const Spot& b);

/// The convex hull, against the clock seen with z to the right and x up.
Polygon hull(Polygon points);
/// What a convex polygon, as `hull` orders it, sweeps while it moves straight from one
/// place to another.
Polygon swept(const Polygon& convex, const Spot& from, const Spot& to);
/// The other half of a section.
Polygon mirrored(Polygon polygon);
/// The points of a convex polygon, as `hull` orders them, whose distance from all its
/// sides is at least `by`; empty if there are none.
Polygon eroded(const Polygon& convex, double by);
/// Whether the insides of two convex polygons, as `hull` orders them, have common points.
bool overlap(const Polygon& a, const Polygon& b);
/// Square of the distance of a point from a segment.
double distance_square(const Spot& p, const Spot& a, const Spot& b);

struct Interval {
  double from = 0, to = 0;
};
using Intervals = std::vector<Interval>;  ///< in rising order, apart from each other
/// What of `a` is not in `b`.
Intervals without(const Intervals& a, const Intervals& b);

enum class Family { columns, rows };

/// The lines of one family, and on each the intervals that a body covers.
class Lines {
 public:
  Lines(Family family, double from, double to, double pitch);

  std::size_t size() const { return on_.size(); }
  /// z of a column, x of a row.
  double at(std::size_t i) const { return first_ + pitch_ * static_cast<double>(i); }
  const Intervals& on(std::size_t i) const { return on_[i]; }
  Spot spot(std::size_t i, double along) const;

  /// Covers the inside of any closed polygon.
  void fill(const Polygon& polygon);
  /// Takes off a convex polygon; `taken` hears of each line how much that was.
  void cut(const Polygon& convex);
  using Taken = std::function<void(std::size_t line, double length)>;
  void cut(const Polygon& convex, const Taken& taken);
  /// Largest length that a convex polygon has in common with the body on one line.
  double common(const Polygon& convex) const;
  void keep_only(std::size_t i, const Interval& kept);
  void clear(std::size_t i) { on_[i].clear(); }

  /// Calls f(line, interval) for every line that a convex polygon meets.
  template <class F>
  void for_each(const Polygon& convex, F f) const {
    const auto [from, to] = range(convex);
    if (from >= to) return;
    spans(convex, from, to);
    for (std::size_t i = from; i < to; ++i)
      if (spans_[i - from].from < spans_[i - from].to) f(i, spans_[i - from]);
  }

 private:
  double across(const Spot& p) const { return family_ == Family::columns ? p.z : p.x; }
  double along(const Spot& p) const { return family_ == Family::columns ? p.x : p.z; }
  /// The first line at or above a place, held in the family.
  std::size_t from(double place) const;
  std::pair<std::size_t, std::size_t> range(const Polygon& polygon) const;
  void spans(const Polygon& convex, std::size_t from, std::size_t to) const;

  Family family_;
  double first_, pitch_;
  std::vector<Intervals> on_;
  mutable Intervals spans_;  // of the polygon at hand
};

/// A half section on both families.
class Section {
 public:
  /// Of everything between two places along the axis and two radii, empty.
  Section(const Spot& low, const Spot& high, double pitch);

  void fill(const Polygon& polygon);
  /// Takes off what a convex polygon sweeps out around the axis: its mirror image too.
  void cut(const Polygon& convex);
  /// The same, and how much that was of each line of a family.
  void cut(const Polygon& convex, Family family, const Lines::Taken& taken);
  /// Roughly how deep a convex polygon, or its mirror image, is in the body; 0 if it does
  /// not meet it.
  double depth(const Polygon& convex) const;
  /// Removes what no longer hangs together with what is at a place along the axis.
  void drop_loose(double z);

  Lines columns, rows;
};

}  // namespace turnwright::review
