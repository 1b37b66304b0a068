#include "turnwright/nc/path.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace turnwright::nc {
namespace {

constexpr double kRounding = 1e-9;  // of the radius: a quarter circle ends upright

double dot(const Normal& a, const Normal& b) { return a.h * b.h + a.z * b.z; }

// Along the axis from a centre to where a circle has a height, or the other way round.
double half_chord(double radius_mm, double across_mm) {
  return std::sqrt(std::max(0.0, radius_mm * radius_mm - across_mm * across_mm));
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
  const double side = step > 0 ? 1 : -1;  // of the higher line, seen from the edge
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

std::optional<Arc> tip_arc(const Arc& a, double r, const Beside& beside) {
  const double R = std::hypot(a.from.h_mm - a.centre.h_mm, a.from.z_mm - a.centre.z_mm);
  const double rho = a.convex ? R + r : R - r;
  if (!(rho > -kRounding * R)) return std::nullopt;
  const double outwards = a.convex ? 1 : -1;
  const Point centre{a.centre.h_mm - r, a.centre.z_mm - r};
  const auto n_from = arc_normal(a, a.from), n_to = arc_normal(a, a.to);
  Arc t{tip(a.from, n_from, r), tip(a.to, n_to, r), centre, a.convex};
  const auto at_height = [&](double h, double side) {
    return Point{h, centre.z_mm + side * outwards * half_chord(rho, h - centre.h_mm)};
  };
  if (n_from.z >= 0 && t.from.h_mm < beside.before_mm)
    t.from = at_height(beside.before_mm, 1);
  if (n_to.z < 0 && t.to.h_mm < beside.after_mm) t.to = at_height(beside.after_mm, -1);
  if (t.to.z_mm < beside.wall_z_mm)
    t.to = {centre.h_mm + outwards * half_chord(rho, beside.wall_z_mm - centre.z_mm),
            beside.wall_z_mm};
  if (!(t.from.z_mm >= t.to.z_mm)) return std::nullopt;
  return t;
}

}  // namespace turnwright::nc
