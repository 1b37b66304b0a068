#pragma once
#include <Eigen/Geometry>
#include <vector>

#include "step_face.hpp"
#include "turnwright/exchange/profile.hpp"

namespace turnwright::exchange {

/// What lies so close together is meant to be one place: programs write files with six or
/// more decimals, and no turned feature is as small.
inline constexpr double kSame_mm = 1e-3;
/// Directions that differ by less are parallel: kSame_mm over 100 mm.
inline constexpr double kParallel_rad = 1e-5;

/// A line with a direction, seen as the axis of cylindrical coordinates.
struct Axis {
  Eigen::Vector3d origin, direction;

  double z_mm(const Eigen::Vector3d& p) const { return direction.dot(p - origin); }
  Eigen::Vector3d radial(const Eigen::Vector3d& p) const {
    return p - origin - direction * z_mm(p);
  }
  double r_mm(const Eigen::Vector3d& p) const { return radial(p).norm(); }
  Point point(const Eigen::Vector3d& p) const { return {z_mm(p), r_mm(p)}; }
  bool parallel(const Eigen::Vector3d& unit) const {
    return direction.cross(unit).norm() < kParallel_rad;
  }
  bool across(const Eigen::Vector3d& unit) const {
    return std::abs(direction.dot(unit)) < kParallel_rad;
  }
};

/// Whether the axis is one of the face's surface: a plane across it counts, and a sphere
/// whose centre lies on it.
bool coaxial(const Surface& surface, const Axis& axis);

/// The axis with the largest area of cylinders, cones and tori, in the direction and with
/// the origin that read_step promises: z = 0 is wherever the file's is.
/// @throws InputError if no face turns about an axis, or if there are more axes than a
///         turned part has.
Axis turning_axis(const std::vector<Face>& faces);

}  // namespace turnwright::exchange
