#pragma once
#include <Eigen/Core>

#include "step_face.hpp"

namespace turnwright::exchange {

/// Points, placements, curves and surfaces of ISO 10303-42, in mm and rad.
class Geometry {
 public:
  Geometry(double mm, double rad) : mm_(mm), rad_(rad) {}

  Eigen::Vector3d point(const Instance& cartesian_point) const;
  /// Unit vector; @throws InputError if its length is zero.
  Eigen::Vector3d direction(const Instance& direction) const;
  Surface surface(Instance surface) const;
  /// Kind, centre, normal and radius of an edge's curve; from and to are left alone.
  /// @param along  whether the boundary runs as the curve does
  void curve(Instance curve, bool along, Boundary& boundary) const;

 private:
  struct Placement {
    Eigen::Vector3d origin, axis;
  };
  Placement placement(const Instance& axis) const;
  Surface revolved(const Record& revolution) const;
  Surface extruded(const Record& extrusion) const;
  double length(const Parameter& p) const { return p.measure() * mm_; }
  double positive(const Parameter& p) const;

  double mm_, rad_;
};

}  // namespace turnwright::exchange
