#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "step_body.hpp"

namespace turnwright::exchange {

/// A surface of the kinds that turning and milling make; a surface of revolution becomes
/// the one that its line or circle sweeps.  What is called its normal here points along the
/// axis (plane), away from it (cylinder, cone), out of the tube (torus), from the centre
/// (sphere).
struct Surface {
  enum class Kind { plane, cylinder, cone, torus, sphere, other };
  Kind kind = Kind::other;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< unit vector; any of a sphere
  double radius_mm = 0;   ///< of a cone at its origin, of a torus to the tube's middle
  double tube_mm = 0;     ///< radius of a torus's tube
  double slope_rad = 0;   ///< of a cone, half its angle: r grows along the axis
  bool reversed = false;  ///< the file's parameters give the opposite normal
  std::string name;       ///< of the entity
};

/// A piece of a face's boundary, in the direction in which the boundary runs: the face lies
/// on its left when seen against the face's normal.
struct Boundary {
  enum class Kind { line, circle, other };
  Kind kind = Kind::other;
  Eigen::Vector3d from, to;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< the circle turns left about it
  double radius_mm = 0;
  std::size_t edge = 0;  ///< the same for both faces that meet here
  /// Angle of the arc, (0, 2 pi].
  double turn_rad() const;
};

struct Face {
  Id id = 0;
  Surface surface;
  double sense = 1;    ///< +1: the face's normal is the surface's normal, else -1
  double outward = 1;  ///< +1: the surface's normal points out of the material, else -1
  std::vector<Boundary> boundary;
  std::vector<Eigen::Vector3d> points;  ///< vertices that are loops: the tip of a cone
};

/// The faces of a body in mm.
/// @throws InputError listing what is broken, such as an axis of length zero.
std::vector<Face> step_faces(const Exchange& file, const Body& body);

}  // namespace turnwright::exchange
