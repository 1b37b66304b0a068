#include "removal.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace turnwright::report {
namespace {

using Shape = Cutter::Shape;

constexpr double kRises_rad = std::numbers::pi / 6;
constexpr int kHalvings = 40;  // of the share of a way; far below a picture's line
constexpr int kChords = 16;

// Behind the point of a tool, towards the free end; infinite where the tool has nothing.
double height(const Cutter& c, double behind_mm) {
  const double u = behind_mm, r = c.size_mm;
  if (u < 0) return INFINITY;
  switch (c.shape) {
    case Shape::corner:
    case Shape::bore: {
      const double tangent = r * (1 + std::sin(kRises_rad));
      if (u > tangent)
        return r * (1 - std::cos(kRises_rad)) + (u - tangent) * std::tan(kRises_rad);
      return r - std::sqrt(std::max(0.0, r * r - (u - r) * (u - r)));
    }
    case Shape::face:
      return u < r ? r - std::sqrt(r * r - (u - r) * (u - r)) : 0;
    case Shape::blade:
    case Shape::bore_blade:
      return u <= r ? 0 : INFINITY;
    case Shape::drill:
    case Shape::nothing:
      break;
  }
  return INFINITY;
}

// Least of a function that is convex where it is finite, at 0 <= s <= 1.
template <class F>
double least(F&& f) {
  double low = 0, high = 1;
  for (int i = 0; i < kHalvings; ++i) {
    const double third = (high - low) / 3;
    if (f(low + third) < f(high - third))
      high -= third;
    else
      low += third;
  }
  return std::min({f(0.0), f(1.0), f((low + high) / 2)});
}

struct Way {
  toolpath::Point from, to;
  double z(double s) const { return std::lerp(from.z_mm, to.z_mm, s); }
  double x(double s) const { return std::lerp(from.h_mm, to.h_mm, s); }
};

// The part of a way on which a tool is above a column: 0 <= z - z(s) <= reach.
std::optional<Way> above(const Way& way, double z, double reach) {
  const double run = way.to.z_mm - way.from.z_mm;
  if (run == 0) {
    const double u = z - way.from.z_mm;
    return u >= 0 && u <= reach ? std::optional(way) : std::nullopt;
  }
  double s0 = (z - reach - way.from.z_mm) / run, s1 = (z - way.from.z_mm) / run;
  if (s0 > s1) std::swap(s0, s1);
  s0 = std::max(s0, 0.0);
  s1 = std::min(s1, 1.0);
  if (!(s0 <= s1)) return std::nullopt;
  return Way{{way.x(s0), way.z(s0)}, {way.x(s1), way.z(s1)}};
}

void drill(Work& work, const Cutter& c, double tip_z) {
  const double slope = std::tan(c.half_point_rad);
  for (std::size_t i = 0; i < work.rings.size(); ++i) {
    const double deep = std::min(c.size_mm, (work.z(i) - tip_z) * slope);
    work.rings[i].inner_mm = std::max(work.rings[i].inner_mm, deep);
  }
}

}  // namespace

void take_off(Work& work, const Cutter& c, const toolpath::Point& from,
              const toolpath::Point& to) {
  if (c.shape == Shape::nothing) return;
  if (c.shape == Shape::drill) return drill(work, c, std::min(from.z_mm, to.z_mm));
  const bool bore = c.shape == Shape::bore || c.shape == Shape::bore_blade;
  const bool blade = c.shape == Shape::blade || c.shape == Shape::bore_blade;
  const double sign = bore ? -1 : 1, reach = blade ? c.size_mm : INFINITY;
  // Heights count downwards in a bore, and outside not beyond the axis.
  const double deepest =
      bore ? -std::max(from.h_mm, to.h_mm) : std::max(0.0, std::min(from.h_mm, to.h_mm));
  for (std::size_t i = 0; i < work.rings.size(); ++i) {
    auto& ring = work.rings[i];
    if ((bore ? -ring.inner_mm : ring.outer_mm) <= deepest) continue;
    const double z = work.z(i);
    const auto way = above({from, to}, z, reach);
    if (!way) continue;
    const double h = least([&](double s) {
      return sign * way->x(s) + height(c, std::clamp(z - way->z(s), 0.0, reach));
    });
    if (bore)
      ring.inner_mm = std::max(ring.inner_mm, -h);
    else
      ring.outer_mm = std::min(ring.outer_mm, std::max(0.0, h));
  }
}

std::vector<toolpath::Point> way(const toolpath::Point& from,
                                 const toolpath::Move& move) {
  const toolpath::Point to{move.x_mm, move.z_mm};
  if (move.kind != toolpath::Move::Kind::arc) return {to};
  const auto& centre = move.centre;
  const auto angle = [&](const toolpath::Point& p) {
    return std::atan2(p.h_mm - centre.h_mm, p.z_mm - centre.z_mm);
  };
  const double r = std::hypot(from.h_mm - centre.h_mm, from.z_mm - centre.z_mm);
  const double turn = std::remainder(angle(to) - angle(from), 2 * std::numbers::pi);
  std::vector<toolpath::Point> points;
  for (int k = 1; k < kChords; ++k) {
    const double a = angle(from) + turn * k / kChords;
    points.push_back({centre.h_mm + r * std::sin(a), centre.z_mm + r * std::cos(a)});
  }
  points.push_back(to);
  return points;
}

void take_off(Work& work, const Cutter& c, const toolpath::Point& from,
              const toolpath::Move& move) {
  toolpath::Point at = from;
  for (const auto& next : way(from, move)) {
    take_off(work, c, at, next);
    at = next;
  }
}

}  // namespace turnwright::report
