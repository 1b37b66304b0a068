#include "turnwright/toolpath/path.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace turnwright::toolpath {
namespace {

constexpr double kRounding = 1e-9;  // of the radius: a quarter circle ends upright

double dot(const Normal& a, const Normal& b) { return a.h * b.h + a.z * b.z; }

// Distance along the axis from a centre to a point of its circle with a given height, or
// the reverse.
double half_chord(double radius_mm, double across_mm) {
  return std::sqrt(std::max(0.0, radius_mm * radius_mm - across_mm * across_mm));
}

constexpr double kTurn = 2 * std::numbers::pi;
constexpr int kPoints = 64;  // tested along an arc

double apart(const Point& a, const Point& b) {
  return std::hypot(a.h_mm - b.h_mm, a.z_mm - b.z_mm);
}

// Angle about a centre from one point to another, by the shorter arc.
double turn(const Point& centre, const Point& a, const Point& b) {
  const auto angle = [&](const Point& p) {
    return std::atan2(p.h_mm - centre.h_mm, p.z_mm - centre.z_mm);
  };
  return std::remainder(angle(b) - angle(a), kTurn);
}

// Lower bound of the distance between the disc of a corner and a piece, from the extents
// of both.
double between_mm(const Piece& piece, const Point& centre, double r) {
  const auto [low, high] = std::minmax(piece.from.z_mm, piece.to.z_mm);
  return std::max(low - centre.z_mm, centre.z_mm - high) - r;
}

// Points of the pieces that are tested against a straight minor edge.
std::vector<Point> held(std::span<const Piece> pieces) {
  std::vector<Point> all;
  for (const auto& piece : pieces) {
    all.insert(all.end(), {piece.from, piece.to});
    if (!piece.arc) continue;
    const auto course = around(*piece.arc);
    for (int i = 1; i < kPoints; ++i)
      all.push_back(course.at(course.length_mm * i / kPoints));
  }
  return all;
}

// Depth of a point below the minor edge.
double below_mm(const Point& p, const Point& centre, double r, double rises_rad) {
  const double c = std::cos(rises_rad), s = std::sin(rises_rad);
  const double h = p.h_mm - centre.h_mm, z = p.z_mm - centre.z_mm;
  return z > 0 && z * c + h * s > 0 ? z * s - h * c - r : INFINITY;
}

}  // namespace

Normal normal(const Point& from, const Point& to) {
  const double dh = to.h_mm - from.h_mm, dz = to.z_mm - from.z_mm;
  const double l = std::hypot(dh, dz);
  if (!(l > 0)) throw std::domain_error("normal: two different points");
  return {-dz / l, dh / l};
}

Point tip(const Point& p, const Normal& n, double r) {
  return {p.h_mm + r * (n.h - 1), p.z_mm + r * (n.z - 1)};  // Eq. (1)
}

Point tip(const Point& p, const Normal& m, const Normal& n, double r) {
  const double k = 1 / (1 + dot(m, n));
  return tip(p, {(m.h + n.h) * k, (m.z + n.z) * k}, r);  // Eq. (2)
}

Crossing across(const Point& a, const Normal& m, const Point& b, const Normal& n,
                double r) {
  const auto above = [](const Point& p, const Point& from, const Normal& of) {
    return dot({p.h_mm - from.h_mm, p.z_mm - from.z_mm}, of);
  };
  const auto moved = [](const Point& p, const Normal& by, double way) {
    return Point{p.h_mm + by.h * way, p.z_mm + by.z * way};
  };
  const auto along = [](const Normal& of) { return Normal{of.z, -of.h}; };
  const double step = above(b, a, m);
  if (std::abs(step) <= kRounding) return {tip(a, m, n, r), tip(b, m, n, r)};
  const auto &edge = step > 0 ? b : a, &other = step > 0 ? a : b;
  const auto &low = step > 0 ? m : n, &high = step > 0 ? n : m;
  const double side = step > 0 ? 1 : -1;  // side of the higher line, seen from the edge
  const double angle = dot(n, along(m));
  if (angle < -kRounding) {  // an inner corner, if the corner comes down to both lines
    const auto both = tip(moved(a, along(m), above(b, a, n) / angle), m, n, r);
    const Point centre{both.h_mm + r, both.z_mm + r};
    if (side * above(centre, edge, along(high)) >= 0) return {both, both};
  }
  // The corner stands on the lower line and touches the edge of the higher.
  const double height = std::min(r, above(edge, other, low));
  const auto below =
      tip(moved(moved(edge, low, -height), along(low), -side * half_chord(r, r - height)),
          low, r);
  const auto up =
      moved(below, low, above(tip(edge, high, r), below, high) / dot(high, low));
  return step > 0 ? Crossing{below, up} : Crossing{up, below};
}

std::vector<Point> tips(const std::vector<Point>& contour, double r) {
  std::vector<Point> all;
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const auto& p = contour[i];
    const auto before = normal(contour[i > 0 ? i - 1 : 0], contour[i > 0 ? i : 1]);
    const auto after = i + 1 < contour.size() ? normal(p, contour[i + 1]) : before;
    all.push_back(tip(p, before, after, r));
  }
  return all;
}

Arc arc_through(const Point& from, const Point& to, double R, bool convex) {
  const double dh = to.h_mm - from.h_mm, dz = to.z_mm - from.z_mm;
  const double c = std::hypot(dh, dz);
  if (!(R >= c / 2 * (1 - kRounding)) || !(c > 0))
    throw std::domain_error("arc_through: a radius of at least half the chord");
  const auto n = normal(from, to);
  const double side = (convex ? -1 : 1) * half_chord(R, c / 2);
  return {
      from,
      to,
      {(from.h_mm + to.h_mm) / 2 + side * n.h, (from.z_mm + to.z_mm) / 2 + side * n.z},
      convex};
}

Normal arc_normal(const Arc& a, const Point& at) {
  const double h = at.h_mm - a.centre.h_mm, z = at.z_mm - a.centre.z_mm;
  const double R = (a.convex ? 1 : -1) * std::hypot(h, z);
  return {h / R, z / R};
}

std::optional<Arc> tip_arc(const Arc& a, double r) {
  const double R = std::hypot(a.from.h_mm - a.centre.h_mm, a.from.z_mm - a.centre.z_mm);
  if (!a.convex && !(R - r > -kRounding * R)) return std::nullopt;
  return Arc{tip(a.from, arc_normal(a, a.from), r),
             tip(a.to, arc_normal(a, a.to), r),
             {a.centre.h_mm - r, a.centre.z_mm - r},
             a.convex};
}

double distance_mm(const Piece& piece, const Point& p) {
  const auto &a = piece.from, &b = piece.to;
  const double to_ends = std::min(apart(p, a), apart(p, b));
  if (piece.arc) {
    const auto& m = piece.arc->centre;
    const double half = turn(m, a, b) / 2, from_middle = turn(m, a, p) - half;
    const bool beside = std::abs(std::remainder(from_middle, kTurn)) > std::abs(half);
    return beside ? to_ends : std::abs(apart(p, m) - apart(a, m));
  }
  const double l = apart(a, b);
  if (!(l > 0)) return to_ends;
  const Normal way{(b.h_mm - a.h_mm) / l, (b.z_mm - a.z_mm) / l};
  const Normal to{p.h_mm - a.h_mm, p.z_mm - a.z_mm};
  const double s = dot(to, way);
  return s <= 0 || s >= l ? to_ends : std::abs(to.h * way.z - to.z * way.h);
}

Course along(std::vector<Point> way) {
  std::vector<double> reached{0};
  for (std::size_t i = 1; i < way.size(); ++i)
    reached.push_back(reached.back() + apart(way[i - 1], way[i]));
  const double length = reached.back();
  return {length, [way = std::move(way), reached = std::move(reached)](double s) {
            const auto next = std::upper_bound(reached.begin(), reached.end(), s);
            if (next == reached.end()) return way.back();
            const auto i = static_cast<std::size_t>(next - reached.begin());
            const double u = (s - reached[i - 1]) / (reached[i] - reached[i - 1]);
            return Point{std::lerp(way[i - 1].h_mm, way[i].h_mm, u),
                         std::lerp(way[i - 1].z_mm, way[i].z_mm, u)};
          }};
}

Course around(const Arc& arc) {
  const double R = apart(arc.from, arc.centre), all = turn(arc.centre, arc.from, arc.to);
  const double begin =
      std::atan2(arc.from.h_mm - arc.centre.h_mm, arc.from.z_mm - arc.centre.z_mm);
  const double length = R * std::abs(all);
  return {length, [=, centre = arc.centre](double s) {
            const double a = begin + (length > 0 ? all * s / length : 0);
            return Point{centre.h_mm + R * std::sin(a), centre.z_mm + R * std::cos(a)};
          }};
}

Course backwards(Course course) {
  const double length = course.length_mm;
  return {length,
          [length, at = std::move(course.at)](double s) { return at(length - s); }};
}

double free_mm(const Course& tip, std::span<const Piece> pieces, const Corner& corner) {
  constexpr double kTouch = 1e-6;  // mm
  constexpr double kStep = 1e-3;   // cuts off less than 1e-6 mm where an edge is grazed
  const double r = corner.re_mm;
  const auto edge_points = corner.rises_rad ? held(pieces) : std::vector<Point>{};
  const auto room = [&](double s) {
    const auto p = tip.at(s);
    const Point centre{p.h_mm + r, p.z_mm + r};
    double least = INFINITY;
    for (const auto& piece : pieces)
      if (between_mm(piece, centre, r) < least)
        least = std::min(least, distance_mm(piece, centre) - r);
    for (const auto& point : edge_points)
      least = std::min(least, below_mm(point, centre, r, *corner.rises_rad));
    return least + kTouch;
  };
  double free = 0, now = room(0);
  if (!(now > 0)) return 0;
  while (free < tip.length_mm) {
    const double next = std::min(free + std::max(now, kStep), tip.length_mm);
    now = room(next);
    if (now > 0) {
      free = next;
      continue;
    }
    double low = free, high = next;
    for (int i = 0; i < 40; ++i)
      (room((low + high) / 2) > 0 ? low : high) = (low + high) / 2;
    return low;
  }
  return tip.length_mm;
}

}  // namespace turnwright::toolpath
