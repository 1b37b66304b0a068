#include "step_pocket.hpp"

#include <cmath>
#include <numbers>
#include <optional>

namespace turnwright::exchange {
namespace {

using Eigen::Vector3d;
using Kind = Surface::Kind;

constexpr std::size_t kMostFlats = 32;  // of one group; a spline shaft has its own cutter

/// One plane along the axis, of one face or of several that divide it.
struct Flat {
  Vector3d normal;       // out of the material
  double height_mm = 0;  // above the axis, where the normal points to
  Range z;
  std::vector<const Face*> faces;
};

/// The planes along the axis, the round ends and the square ends of connected faces.
struct Sides {
  std::vector<Flat> along;
  std::vector<const Face*> round, square, others;
};

Range z_range(const Face& face, const Axis& axis) {
  Range z;
  for (const auto& b : face.boundary) z.add(axis.z_mm(b.from));
  return z;
}

void add_plane(const Face& face, const Axis& axis, std::vector<Flat>& all) {
  Flat own;
  own.normal = face.outward * face.surface.axis;
  own.height_mm = own.normal.dot(face.surface.origin - axis.origin);
  own.z = z_range(face, axis);
  own.faces = {&face};
  for (auto& flat : all)
    if (flat.normal.dot(own.normal) > 0 &&
        flat.normal.cross(own.normal).norm() < kParallel_rad &&
        std::abs(flat.height_mm - own.height_mm) < kSame_mm) {
      flat.z.add(own.z.from), flat.z.add(own.z.to);
      flat.faces.push_back(&face);
      return;
    }
  all.push_back(std::move(own));
}

Sides sorted(const std::vector<const Face*>& group, const Axis& axis) {
  Sides p;
  for (const auto* f : group) {
    const auto& s = f->surface;
    const bool across = axis.across(s.axis);
    if (s.kind == Kind::plane && across && p.along.size() < kMostFlats)
      add_plane(*f, axis, p.along);
    else if (s.kind == Kind::plane && axis.parallel(s.axis))
      p.square.push_back(f);
    else if (s.kind == Kind::cylinder && across && f->outward < 0)
      p.round.push_back(f);
    else
      p.others.push_back(f);
  }
  return p;
}

Pocket pocket(Milled::Kind kind, const Flat& floor, const Range& z, const Axis& axis) {
  Pocket f;
  f.milled.kind = kind;
  f.milled.z_mm = z.from, f.milled.length_mm = z.to - z.from;
  f.milled.angle_deg = angle_deg(floor.normal, axis);
  f.floor_mm = floor.height_mm;
  return f;
}

std::vector<Pocket> flats(const Sides& p, const Axis& axis) {
  std::vector<Pocket> all;
  if (!p.round.empty() || !p.others.empty()) return all;
  for (const auto& plane : p.along) {
    all.push_back(pocket(Milled::Kind::flat, plane, plane.z, axis));
    for (const auto* f : plane.faces) all.back().milled.sources.push_back(name_of(f->id));
  }
  return all;
}

/// Distance of two walls that face each other across a floor, at equal distances from the
/// plane through the axis.
std::optional<double> width_mm(const Flat& floor, const Flat& a, const Flat& b) {
  const bool opposite =
      a.normal.cross(b.normal).norm() < kParallel_rad && a.normal.dot(b.normal) < 0;
  const double left = -a.height_mm, right = -b.height_mm;
  if (!opposite || std::abs(a.normal.dot(floor.normal)) > kParallel_rad ||
      !(left > 0 && std::abs(left - right) < 2 * kSame_mm))
    return std::nullopt;
  return left + right;
}

/// Whether a hollow cylinder is the end of a keyway of this width, above whose middle its
/// axis stands.
bool rounds(const Face& end, const Flat& floor, double width, const Axis& axis) {
  const auto& s = end.surface;
  return std::abs(s.radius_mm - width / 2) < kSame_mm &&
         floor.normal.cross(s.axis).norm() < kParallel_rad &&
         floor.normal.cross(axis.radial(s.origin)).norm() < kSame_mm;
}

/// A floor between walls that run along z; the ends are half cylinders as wide as the walls
/// are apart, their axes where the walls end, square, or open.
std::optional<Pocket> keyway(const Sides& p, const Flat& floor, const Range& walls,
                             double width, const Axis& axis) {
  Range z = walls;
  bool left = false, right = false;
  for (const auto* end : p.round) {
    if (!rounds(*end, floor, width, axis)) return std::nullopt;
    const double middle = axis.z_mm(end->surface.origin);
    const bool at_left = std::abs(middle - walls.from) < std::abs(middle - walls.to);
    if (std::abs(middle - (at_left ? walls.from : walls.to)) > kSame_mm)
      return std::nullopt;
    (at_left ? left : right) = true;
    z.add(middle + (at_left ? -1 : 1) * width / 2);
  }
  const double middle = (z.from + z.to) / 2;
  for (const auto* end : p.square)
    (axis.z_mm(end->surface.origin) < middle ? left : right) = true;
  auto f =
      pocket(left && right ? Milled::Kind::keyway : Milled::Kind::slot, floor, z, axis);
  f.milled.width_mm = width;
  f.square_ends = !p.square.empty();
  return f;
}

std::optional<Pocket> keyway(const Sides& p, const std::vector<const Face*>& group,
                             const Axis& axis) {
  if (p.along.size() != 3 || !p.others.empty()) return std::nullopt;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto &floor = p.along[i], &a = p.along[(i + 1) % 3], &b = p.along[(i + 2) % 3];
    const auto width = width_mm(floor, a, b);
    Range walls = a.z;
    walls.add(b.z.from), walls.add(b.z.to);
    auto f = width ? keyway(p, floor, walls, *width, axis) : std::nullopt;
    if (!f) continue;
    for (const auto* face : group) f->milled.sources.push_back(name_of(face->id));
    return f;
  }
  return std::nullopt;
}

}  // namespace

double angle_deg(const Vector3d& normal, const Axis& axis) {
  const bool along_z = axis.parallel(Vector3d::UnitZ());
  const Vector3d file = along_z ? Vector3d::UnitX() : Vector3d::UnitZ();
  const Vector3d zero = (file - axis.direction * axis.direction.dot(file)).normalized();
  const double angle =
      std::atan2(axis.direction.dot(zero.cross(normal)), zero.dot(normal));
  constexpr double kRounding = 1e-9;  // deg
  const double deg = angle * 180 / std::numbers::pi;
  if (std::abs(deg - std::round(deg)) > kRounding) return deg;
  return std::round(deg) == -180 ? 180 : std::round(deg) + 0.0;
}

std::vector<Pocket> pockets(const std::vector<const Face*>& group, const Axis& axis) {
  const auto sides = sorted(group, axis);
  if (auto key = keyway(sides, group, axis)) return {std::move(*key)};
  return flats(sides, axis);
}

}  // namespace turnwright::exchange
