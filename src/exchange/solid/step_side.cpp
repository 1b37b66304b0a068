#include "step_side.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "turnwright/base/cancelled.hpp"

namespace turnwright::exchange {
namespace {

using Eigen::Vector3d;
constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kWhole = 1e-3;  // rad, of a sum of angles that is 0 or a whole turn

/// Part of a circle about the axis in the boundary of a face.
struct Ring {
  Point at;
  double turn_rad = 0;  // > 0
  bool ahead = false;   // the face goes on from here along the side, Eq. (1)
};

/// What the boundary of a face says about the axis.
struct Rim {
  std::vector<Ring> rings;
  std::vector<double> poles_mm;  // z of vertices and lines on the axis
  bool surrounds = false;        // the boundary goes once round the axis
};

double swept_rad(const Axis& axis, const Vector3d& from, const Vector3d& to) {
  const Vector3d a = axis.radial(from), b = axis.radial(to);
  if (a.norm() < kSame_mm || b.norm() < kSame_mm) return 0;
  return std::atan2(axis.direction.dot(a.cross(b)), a.dot(b));
}

/// Angle about the axis that a piece of boundary which is no ring sweeps.
double swept_rad(const Axis& axis, const Boundary& b) {
  if (b.kind != Boundary::Kind::circle) return swept_rad(axis, b.from, b.to);
  constexpr int kPieces = 24;
  const Vector3d out = b.from - b.centre, along = b.normal.cross(out);
  const double turn = b.turn_rad();
  double sum = 0;
  Vector3d before = b.from;
  for (int i = 1; i <= kPieces; ++i) {
    const double t = turn * i / kPieces;
    const Vector3d p = b.centre + std::cos(t) * out + std::sin(t) * along;
    sum += swept_rad(axis, before, p);
    before = p;
  }
  return sum;
}

/// Points where the whole line or circle of a piece of boundary is nearest to the axis or
/// meets it.
std::vector<Vector3d> nearest_axis(const Axis& axis, const Boundary& b) {
  if (b.kind == Boundary::Kind::line) {
    const Vector3d a = axis.radial(b.from), d = axis.radial(b.to) - a;
    const double t = std::clamp(-a.dot(d) / std::max(d.squaredNorm(), 1e-300), 0.0, 1.0);
    return {b.from + t * (b.to - b.from)};
  }
  const double steep = axis.direction.dot(b.normal);
  if (std::abs(steep) > kParallel_rad) {  // the axis crosses the plane of the circle
    const double t = (b.centre - axis.origin).dot(b.normal) / steep;
    return {axis.origin + t * axis.direction};
  }
  const double h = axis.r_mm(b.centre), R = b.radius_mm;
  if (!(h < R)) return {};
  const Vector3d foot = b.centre - axis.radial(b.centre);
  const Vector3d up = axis.direction * std::sqrt(R * R - h * h);
  return {foot + up, foot - up};
}

/// Whether a point lies on the arc.
bool on_arc(const Boundary& b, const Vector3d& p) {
  if (!(std::abs((p - b.centre).norm() - b.radius_mm) < kSame_mm)) return false;
  auto part = b;
  part.to = p;
  return part.turn_rad() <= b.turn_rad() &&
         std::abs((p - b.centre).dot(b.normal)) < kSame_mm;
}

/// z where a line or an arc of the boundary passes through the axis.
void add_crossings(const Axis& axis, const Boundary& b, std::vector<double>& poles_mm) {
  if (b.kind == Boundary::Kind::other) return;
  for (const auto& p : nearest_axis(axis, b))
    if (axis.r_mm(p) < kSame_mm && (b.kind == Boundary::Kind::line || on_arc(b, p)))
      poles_mm.push_back(axis.z_mm(p));
}

Rim rim_of(const Face& face, const Axis& axis) {
  Rim rim;
  double swept = 0;
  const double material_right = face.sense * face.outward;
  for (const auto& b : face.boundary) {
    const bool ring = b.kind == Boundary::Kind::circle && axis.parallel(b.normal) &&
                      axis.r_mm(b.centre) < kSame_mm;
    if (ring) {
      const double left = axis.direction.dot(b.normal) > 0 ? 1 : -1;
      rim.rings.push_back({axis.point(b.from), b.turn_rad(), left * material_right > 0});
      swept += left * b.turn_rad();
      continue;
    }
    swept += swept_rad(axis, b);
    for (const auto* p : {&b.from, &b.to})
      if (axis.r_mm(*p) < kSame_mm) rim.poles_mm.push_back(axis.z_mm(*p));
    add_crossings(axis, b, rim.poles_mm);
  }
  for (const auto& p : face.points)
    if (axis.r_mm(p) < kSame_mm) rim.poles_mm.push_back(axis.z_mm(p));
  rim.surrounds = std::abs(std::abs(swept) - kTurn) < kWhole;
  return rim;
}

double apart_mm(const Point& a, const Point& b) {
  return std::hypot(a.z_mm - b.z_mm, a.r_mm - b.r_mm);
}

/// How much of the circle through a point the rings have.
double round_rad(const Rim& rim, const Point& at) {
  double sum = 0;
  for (const auto& ring : rim.rings)
    if (apart_mm(ring.at, at) < kSame_mm) sum += ring.turn_rad;
  return sum;
}

/// Outermost places of a face whose half section is straight.
std::optional<TurnedSide> straight(const Face& face, const Axis& axis, const Rim& rim) {
  const auto& s = face.surface;
  const double along = s.axis.dot(axis.direction) > 0 ? 1 : -1;
  const double slope = along * s.slope_rad;
  // Normal out of the material, and the way along the side.
  Point n{-std::sin(slope) * face.outward, std::cos(slope) * face.outward};
  if (s.kind == Surface::Kind::plane) n = {along * face.outward, 0};
  const auto place = [&n](const Point& p) { return p.z_mm * n.r_mm - p.r_mm * n.z_mm; };
  std::vector<Point> ends;
  for (const auto& ring : rim.rings) ends.push_back(ring.at);
  for (const double z : rim.poles_mm) ends.push_back({z, 0});
  const bool pointed = s.kind == Surface::Kind::plane || std::abs(slope) > kParallel_rad;
  if (rim.surrounds && rim.poles_mm.empty() && pointed) {
    const double z = axis.z_mm(s.origin);
    const bool plane = s.kind == Surface::Kind::plane;
    ends.push_back({plane ? z : z - s.radius_mm / std::tan(slope), 0});
  }
  if (ends.empty()) return std::nullopt;
  const auto [first, last] = std::minmax_element(
      ends.begin(), ends.end(),
      [&place](const Point& a, const Point& b) { return place(a) < place(b); });
  TurnedSide side;
  using enum TurnedSide::Kind;
  side.kind = s.kind == Surface::Kind::plane      ? plane
              : s.kind == Surface::Kind::cylinder ? cylinder
                                                  : cone;
  side.from = *first, side.to = *last;
  for (auto* p : {&side.from, &side.to}) {
    if (side.kind == plane) p->z_mm = axis.z_mm(s.origin);
    if (side.kind == cylinder) p->r_mm = s.radius_mm;
  }
  return side;
}

/// The ring with the largest part of its circle, of those with the face ahead or behind.
std::optional<Point> widest(const Rim& rim, bool ahead) {
  std::optional<Point> at;
  double most = 0;
  std::set<std::pair<double, double>> judged;  // a file may name one ring again and again
  for (const auto& ring : rim.rings) {
    if (ring.ahead != ahead) continue;
    if (!judged.emplace(ring.at.z_mm, ring.at.r_mm).second) continue;
    leave_if_asked();
    if (const double turn = round_rad(rim, ring.at); turn > most)
      at = ring.at, most = turn;
  }
  return at;
}

/// Where a torus or a sphere ends on the axis.
std::optional<Point> pole(const Face& face, const Rim& rim, const Point& centre,
                          bool right) {
  for (const double z : rim.poles_mm)
    if ((z > centre.z_mm) == right) return Point{z, 0};
  if (!rim.surrounds || face.surface.kind != Surface::Kind::sphere) return std::nullopt;
  return Point{centre.z_mm + (right ? 1 : -1) * face.surface.radius_mm, 0};
}

std::optional<TurnedSide> round(const Face& face, const Axis& axis, const Rim& rim) {
  const auto& s = face.surface;
  const bool sphere = s.kind == Surface::Kind::sphere;
  TurnedSide side;
  side.kind = TurnedSide::Kind::round;
  side.centre = {axis.z_mm(s.origin), sphere ? 0 : s.radius_mm};
  side.radius_mm = sphere ? s.radius_mm : s.tube_mm;
  side.convex = face.outward > 0;
  auto from = widest(rim, true), to = widest(rim, false);
  if (!from) from = pole(face, rim, side.centre, !side.convex);
  if (!to) to = pole(face, rim, side.centre, side.convex);
  if (!from || !to) return std::nullopt;
  side.from = *from, side.to = *to;
  const auto angle = [&side](const Point& p) {
    return std::atan2(p.r_mm - side.centre.r_mm, p.z_mm - side.centre.z_mm);
  };
  const double turn = (angle(side.to) - angle(side.from)) * (side.convex ? -1 : 1);
  side.turn_rad = turn - kTurn * std::floor(turn / kTurn);
  return side;
}

bool on_line(const TurnedSide& a, const Point& p) {
  const double dz = a.to.z_mm - a.from.z_mm, dr = a.to.r_mm - a.from.r_mm;
  const double off = (p.z_mm - a.from.z_mm) * dr - (p.r_mm - a.from.r_mm) * dz;
  return std::abs(off) < kSame_mm * std::hypot(dz, dr);
}

/// Place of p along a straight side [mm].
double along(const TurnedSide& a, const Point& p) {
  const double dz = a.to.z_mm - a.from.z_mm, dr = a.to.r_mm - a.from.r_mm;
  return ((p.z_mm - a.from.z_mm) * dz + (p.r_mm - a.from.r_mm) * dr) / std::hypot(dz, dr);
}

bool same_surface(const TurnedSide& a, const TurnedSide& b) {
  if (a.kind != b.kind) return false;
  if (a.kind == TurnedSide::Kind::round)
    return a.convex == b.convex && apart_mm(a.from, b.from) < kSame_mm &&
           apart_mm(a.to, b.to) < kSame_mm && apart_mm(a.centre, b.centre) < kSame_mm;
  if (!on_line(a, b.from) || !on_line(a, b.to)) return false;
  const double from = along(a, b.from), to = along(a, b.to);
  return from < to && from < along(a, a.to) - kSame_mm && to > kSame_mm;
}

double length_mm(const TurnedSide& a) { return apart_mm(a.from, a.to); }

/// b becomes part of a.
void absorb(TurnedSide& a, const TurnedSide& b) {
  const double round = a.round_rad * length_mm(a) + b.round_rad * length_mm(b);
  if (a.kind != TurnedSide::Kind::round) {
    const Point from = along(a, b.from) < -kSame_mm ? b.from : a.from;
    if (along(a, b.to) > along(a, a.to) + kSame_mm) a.to = b.to;
    a.from = from;
  }
  a.round_rad = round / length_mm(a);
  a.faces.insert(a.faces.end(), b.faces.begin(), b.faces.end());
}

}  // namespace

bool TurnedSide::outside() const {
  if (kind != Kind::round) return to.z_mm > from.z_mm + kSame_mm;
  return convex == ((from.r_mm + to.r_mm) / 2 >= centre.r_mm);
}

std::optional<TurnedSide> side_of(const Face& face, std::size_t index, const Axis& axis) {
  if (!coaxial(face.surface, axis)) return std::nullopt;
  const auto rim = rim_of(face, axis);
  const bool arc = face.surface.kind == Surface::Kind::torus ||
                   face.surface.kind == Surface::Kind::sphere;
  auto side = arc ? round(face, axis, rim) : straight(face, axis, rim);
  if (!side || apart_mm(side->from, side->to) < kSame_mm) return std::nullopt;
  side->round_rad = std::max(round_rad(rim, side->from), round_rad(rim, side->to));
  side->faces = {index};
  return side;
}

std::vector<TurnedSide> merged(std::vector<TurnedSide> sides) {
  std::vector<TurnedSide> out;
  for (auto& side : sides) {
    leave_if_asked();
    // What joins two that were apart takes both.
    for (std::size_t i = 0; i < out.size();) {
      if (!same_surface(out[i], side)) {
        ++i;
        continue;
      }
      absorb(out[i], side);
      side = std::move(out[i]);
      out.erase(out.begin() + static_cast<std::ptrdiff_t>(i));
    }
    out.push_back(std::move(side));
  }
  return out;
}

}  // namespace turnwright::exchange
