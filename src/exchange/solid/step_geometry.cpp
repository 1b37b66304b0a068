#include "step_geometry.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

#include "turnwright/base/language.hpp"

namespace turnwright::exchange {
namespace {

using Eigen::Vector3d;

constexpr int kMostWrappers =
    8;  // a trimmed curve of a surface curve ..; more is a cycle
constexpr double kInPlane = 1e-6;  // of a length: a curve lies in a plane with the axis

Vector3d coordinates(const Parameter& list) {
  if (list.size() != 3) list.refuse(tr("a list of three"));
  return {list[0].measure(), list[1].measure(), list[2].measure()};
}

/// Last of a record's parameters but n, whether the instance is complex or not.
Parameter from_end(const Record& record, std::size_t n) {
  return record[record.size() > n ? record.size() - 1 - n : record.size()];
}

/// The line or circle within what wraps it; `along` becomes its opposite where a wrapper
/// turns its direction.
Instance bare_curve(Instance curve, bool& along) {
  for (int i = 0; i < kMostWrappers; ++i) {
    const auto trimmed = curve.find("TRIMMED_CURVE");
    std::optional<Record> on_surface;
    for (const auto name :
         {"SURFACE_CURVE", "SEAM_CURVE", "INTERSECTION_CURVE", "BOUNDED_SURFACE_CURVE"})
      if (!on_surface && !trimmed) on_surface = curve.find(name);
    if (!trimmed && !on_surface) break;
    if (trimmed) along = along == (*trimmed)[4].boolean();
    curve = trimmed ? (*trimmed)[1].instance() : (*on_surface)[1].instance();
  }
  return curve;
}

}  // namespace

Vector3d Geometry::point(const Instance& cartesian_point) const {
  return mm_ * coordinates(from_end(cartesian_point.as("CARTESIAN_POINT"), 0));
}

Vector3d Geometry::direction(const Instance& direction) const {
  const auto ratios = from_end(direction.as("DIRECTION"), 0);
  const Vector3d v = coordinates(ratios);
  const double length = v.stableNorm();
  if (!(length > 0)) ratios.refuse(tr("a direction that is not zero"));
  return v / length;
}

/// AXIS1_PLACEMENT, AXIS2_PLACEMENT_3D: the axis may be left out, it is z then.
Geometry::Placement Geometry::placement(const Instance& axis) const {
  const auto name = axis.is("AXIS1_PLACEMENT") ? "AXIS1_PLACEMENT" : "AXIS2_PLACEMENT_3D";
  const auto record = axis.as(name);
  const auto z = record[2];
  return {point(record[1].instance()),
          z.absent() ? Vector3d(Vector3d::UnitZ()) : direction(z.instance())};
}

double Geometry::positive(const Parameter& p) const {
  const double x = length(p);
  if (!(x > 0)) p.refuse(tr("a radius > 0"));
  return x;
}

Surface Geometry::surface(Instance item) const {
  for (int i = 0; i < kMostWrappers; ++i) {
    const auto trimmed = item.find("RECTANGULAR_TRIMMED_SURFACE");
    if (!trimmed) break;
    item = (*trimmed)[1].instance();
  }
  Surface s{.name = item.name()};
  const auto elementary = [&](std::string_view name, Surface::Kind kind) {
    const auto record = item.find(name);
    if (!record) return record;
    const auto at = placement((*record)[1].instance());
    s.kind = kind, s.origin = at.origin, s.axis = at.axis;
    return record;
  };
  using enum Surface::Kind;
  if (elementary("PLANE", plane)) return s;
  if (const auto r = elementary("CYLINDRICAL_SURFACE", cylinder))
    return s.radius_mm = positive((*r)[2]), s;
  if (const auto r = elementary("SPHERICAL_SURFACE", sphere))
    return s.radius_mm = positive((*r)[2]), s;
  if (const auto r = elementary("CONICAL_SURFACE", cone)) {
    s.radius_mm = length((*r)[2]);
    s.slope_rad = (*r)[3].measure() * rad_;
    if (!(std::abs(s.slope_rad) < std::numbers::pi / 2))
      (*r)[3].refuse(tr("less than 90 deg"));
    return s;
  }
  for (const auto name : {"TOROIDAL_SURFACE", "DEGENERATE_TOROIDAL_SURFACE"})
    if (const auto r = elementary(name, torus)) {
      s.radius_mm = length((*r)[2]), s.tube_mm = positive((*r)[3]);
      return s;
    }
  if (const auto r = item.find("SURFACE_OF_REVOLUTION")) return revolved(*r);
  if (const auto r = item.find("SURFACE_OF_LINEAR_EXTRUSION")) return extruded(*r);
  return s;
}

/// Symbols: P a point of the curve, d its direction there, O and a the axis, t = a x (P - O)
/// the way of the turn.  The normal of Part 42's surface is t x d.
Surface Geometry::revolved(const Record& revolution) const {
  Surface s{.name = std::string(revolution.name())};
  const auto about = placement(revolution[2].instance());
  const Vector3d &O = about.origin, &a = about.axis;
  bool along = true;
  const auto curve = bare_curve(revolution[1].instance(), along);
  const auto radial = [&O, &a](const Vector3d& p) -> Vector3d {
    return (p - O) - a * a.dot(p - O);
  };
  Vector3d P, d, normal;
  if (const auto line = curve.find("LINE")) {
    P = point((*line)[1].instance());
    d = direction((*line)[2].instance().as("VECTOR")[1].instance());
    if (!(radial(P).norm() > radial(P + d).norm())) P += d;  // not on the axis
    const Vector3d e = radial(P).normalized();
    const double dz = d.dot(a), dr = d.dot(e);
    if (std::abs(d.dot(a.cross(e))) > kInPlane) return s;  // a hyperboloid
    const bool flat = std::abs(dz) < kInPlane, upright = std::abs(dr) < kInPlane;
    s.kind = flat      ? Surface::Kind::plane
             : upright ? Surface::Kind::cylinder
                       : Surface::Kind::cone;
    s.origin = O + a * a.dot(P - O), s.axis = a;
    s.radius_mm = radial(P).norm();
    s.slope_rad = flat || upright ? 0 : std::atan(dr / dz);
    normal = flat ? a : Vector3d(e * std::abs(dz) - a * (dz > 0 ? dr : -dr));
  } else if (const auto circle = curve.find("CIRCLE")) {
    const auto [C, n] = placement((*circle)[1].instance());
    const Vector3d e = radial(C);
    const double R = positive((*circle)[2]);
    if (std::abs(n.dot(a)) > kInPlane || std::abs(n.dot(e)) > kInPlane * R) return s;
    const bool on_axis = e.norm() <= kInPlane * R;
    s.kind = on_axis ? Surface::Kind::sphere : Surface::Kind::torus;
    s.origin = O + a * a.dot(C - O), s.axis = a;
    s.radius_mm = on_axis ? R : e.norm(), s.tube_mm = R;
    const Vector3d out = on_axis ? Vector3d(a.cross(n)) : Vector3d(e.normalized());
    P = C + R * out, d = n.cross(out), normal = out;
  } else {
    return s;
  }
  const Vector3d t = a.cross(P - O);
  s.reversed = t.cross(along ? d : Vector3d(-d)).dot(normal) < 0;
  return s;
}

/// A line sweeps a plane, a circle along its axis a cylinder; the normal of Part 42's surface
/// is (direction of the curve) x (direction of the sweep).
Surface Geometry::extruded(const Record& extrusion) const {
  Surface s{.name = std::string(extrusion.name())};
  bool along = true;
  const auto curve = bare_curve(extrusion[1].instance(), along);
  const auto sweep = direction(extrusion[2].instance().as("VECTOR")[1].instance());
  if (const auto line = curve.find("LINE")) {
    const auto d = direction((*line)[2].instance().as("VECTOR")[1].instance());
    if (d.cross(sweep).norm() < kInPlane) return s;
    s.kind = Surface::Kind::plane;
    s.origin = point((*line)[1].instance());
    s.axis = d.cross(sweep).normalized();
    s.reversed = !along;
  } else if (const auto circle = curve.find("CIRCLE")) {
    const auto [C, n] = placement((*circle)[1].instance());
    if (n.cross(sweep).norm() > kInPlane) return s;
    s.kind = Surface::Kind::cylinder;
    s.origin = C, s.axis = n, s.radius_mm = positive((*circle)[2]);
    s.reversed = (n.dot(sweep) > 0) != along;
  }
  return s;
}

void Geometry::curve(Instance item, bool along, Boundary& boundary) const {
  item = bare_curve(item, along);
  if (item.is("LINE")) boundary.kind = Boundary::Kind::line;
  const auto circle = item.find("CIRCLE");
  if (!circle) return;
  const auto at = placement((*circle)[1].instance());
  boundary.kind = Boundary::Kind::circle;
  boundary.centre = at.origin;
  boundary.normal = along ? at.axis : Vector3d(-at.axis);
  boundary.radius_mm = positive((*circle)[2]);
}

}  // namespace turnwright::exchange
