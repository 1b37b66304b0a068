#include "step_cross_hole.hpp"

#include <algorithm>
#include <cmath>

namespace turnwright::exchange {
namespace {

using Eigen::Vector3d;
using Kind = Surface::Kind;

/// The line along which a hole is drilled.
struct DrillLine {
  Vector3d origin, direction;
  double radius_mm = 0;

  double off_mm(const Vector3d& p) const {
    const Vector3d out = p - origin;
    return (out - direction * direction.dot(out)).norm();
  }
  bool same(const Surface& s) const {
    return s.axis.cross(direction).norm() < kParallel_rad && off_mm(s.origin) < kSame_mm;
  }
};

/// The faces of a hole by what they are of it.
struct HoleFaces {
  std::vector<const Face*> walls, bottoms;
};

std::optional<DrillLine> drilled_along(const Face& face, const Axis& axis) {
  const auto& s = face.surface;
  const double apart =
      std::abs((s.origin - axis.origin).dot(s.axis.cross(axis.direction)));
  if (s.kind != Kind::cylinder || !(face.outward < 0) || !axis.across(s.axis) ||
      apart > kSame_mm)
    return std::nullopt;
  return DrillLine{s.origin, s.axis, s.radius_mm};
}

/// Whether a face closes the hole: nothing of it is wider than the hole.
bool is_bottom(const Face& face, const DrillLine& line) {
  const auto& s = face.surface;
  const bool across =
      s.kind == Kind::plane && s.axis.cross(line.direction).norm() < kParallel_rad;
  return (across || (s.kind == Kind::cone && line.same(s))) &&
         std::ranges::all_of(face.boundary, [&](const Boundary& b) {
           return line.off_mm(b.from) < line.radius_mm + kSame_mm;
         });
}

std::optional<HoleFaces> parts_of(const std::vector<const Face*>& group,
                                  const DrillLine& line) {
  HoleFaces p;
  for (const auto* f : group) {
    const auto& s = f->surface;
    if (s.kind == Kind::cylinder && f->outward < 0 && line.same(s) &&
        std::abs(s.radius_mm - line.radius_mm) < kSame_mm)
      p.walls.push_back(f);
    else if (is_bottom(*f, line))
      p.bottoms.push_back(f);
    else
      return std::nullopt;
  }
  return p;
}

/// How high above the part's axis the wall of a hole begins and ends, along its direction.
struct HoleWalls {
  Range height;
  Range r;                      // of the same corners, from the axis
  std::optional<double> floor;  // of the circle in which it ends

  HoleWalls(const HoleFaces& parts, const DrillLine& line, const Axis& axis) {
    const auto height_mm = [&](const Vector3d& p) {
      return line.direction.dot(axis.radial(p));
    };
    for (const auto* wall : parts.walls)
      for (const auto& b : wall->boundary) {
        height.add(height_mm(b.from)), r.add(axis.r_mm(b.from));
        if (b.kind == Boundary::Kind::circle &&
            b.normal.cross(line.direction).norm() < kParallel_rad)
          floor = height_mm(b.centre);
      }
  }
};

}  // namespace

std::optional<Pocket> cross_hole(const std::vector<const Face*>& group,
                                 const Axis& axis) {
  const auto wall = std::ranges::find_if(
      group, [](const Face* f) { return f->surface.kind == Kind::cylinder; });
  if (wall == group.end()) return std::nullopt;
  const auto line = drilled_along(**wall, axis);
  const auto parts = line ? parts_of(group, *line) : std::nullopt;
  if (!parts) return std::nullopt;
  const HoleWalls walls(*parts, *line, axis);
  Pocket hole;
  auto& m = hole.milled;
  double side = walls.height.to > 0 ? 1 : -1;
  if (!parts->bottoms.empty()) {
    if (!walls.floor) return std::nullopt;
    side = walls.height.to - *walls.floor > *walls.floor - walls.height.from ? 1 : -1;
    hole.floor_mm = side * *walls.floor;
  } else if (walls.height.from < 0 && walls.height.to > 0) {
    m.through = Milled::Through::part;
  } else if (walls.r.to - walls.r.from > kSame_mm) {
    m.through = Milled::Through::wall;
  } else {
    return std::nullopt;
  }
  hole.square_ends = std::ranges::any_of(
      parts->bottoms, [](const Face* f) { return f->surface.kind == Kind::plane; });
  m.kind = Milled::Kind::cross_hole;
  m.z_mm = axis.z_mm(line->origin);
  m.width_mm = 2 * line->radius_mm;
  m.angle_deg = angle_deg(side * line->direction, axis);
  if (m.through == Milled::Through::part && m.angle_deg < 0)
    m.angle_deg += 180;  // either side's
  for (const auto* face : group) m.sources.push_back(name_of(face->id));
  return hole;
}

}  // namespace turnwright::exchange
