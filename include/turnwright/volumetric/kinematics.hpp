#pragma once
#include <array>
#include <vector>

#include "turnwright/volumetric/machine.hpp"

namespace turnwright::volumetric {

/// Programmed positions [mm, rad] and signs of motion, each by kLetters; those of axes
/// that the chain lacks do not count.
struct Position {
  std::array<double, kDirections> q{};
  std::array<double, kDirections> sign{};
};

/// Tip [mm] and direction of the tool's axis in the workpiece frame.
struct ToolPose {
  Vec3 tip_mm{};
  Vec3 direction{0, 0, 1};  ///< (0, 0, 1) at q = 0
};

/// What unit errors of one axis do to the tip, to first order, in the workpiece frame:
/// the columns of d tip/d(EX, EY, EZ, EA, EB, EC) [mm/mm, mm/rad].  A rotary axis'
/// location errors act by the same columns.
struct AxisEffect {
  char axis = 'X';
  std::array<Vec3, kDirections> error{};
  /// Of a linear axis, by EA0, EB0, EC0 [mm/rad]; the one along the axis is zero.
  std::array<Vec3, 3> squareness{};
};

/// An angle by its cosine and sine.
struct Turn {
  double cos = 1, sin = 0;
};

/// A machine's chain made ready to be evaluated at many positions.
///
/// With sigma = +1 for joints between bed and tool, -1 between bed and workpiece, a joint
/// moves by
///
///     linear:  M = Tr(sigma q u) Tr(p) Tr(EX, EY, EZ) Rz(EC) Ry(EB) Rx(EA) Tr(-p) (1)
///     rotary:  M = Tr(p + l) Rz(EC0) Ry(EB0) Rx(EA0) Tr(EX, EY, EZ)
///                  Rz(EC) Ry(EB) Rx(EA) R_axis(sigma q) Tr(-p)                       (2)
///     u_X = (1, EC0X, -EB0X), u_Y = (-EC0Y, 1, EA0Y), u_Z = (EB0Z, -EA0Z, 1)         (3)
///
/// each u divided by its norm, l = (EX0, EY0, EZ0); squareness turns the direction only.
/// The pose of the tool in the workpiece is T_fw^-1 T_ft, each T the product of its
/// joints from the bed outwards.  To first order, at the nominal position,
///
///     e = R_fw^T {sum_tool [d_i + r_i x (P - p_i)] - sum_work [..]}                  (4)
///     linear:  d_i = R_i [(EX, EY, EZ) + sigma q (u - e_axis)],  r_i = R_i (EA, EB, EC)
///     rotary:  d_i = R_i [(EX, EY, EZ) + l],
///              r_i = R_i [(EA, EB, EC) + (EA0, EB0, EC0)]
///
/// P the nominal tip, R_i the nominal rotation of the joints between the bed and joint i,
/// p_i its reference point as they carry it and, if linear, its own travel.
///
/// Valid for rigid bodies.  (4) neglects products of errors, 0.01 um for 100 urad over a
/// lever of 1 m; the gap shrinks fourfold when the errors halve.
/// Source: products of homogeneous transformations in the zero-position form, derived
/// here; checked against dual quaternions in kinematics_test.
class Kinematics {
 public:
  /// @throws std::domain_error if the chain has a fault (chain_fault), its axes are not
  ///   those of the machine, a Q is not > 0, or an axis has errors it cannot have.
  explicit Kinematics(const Machine& machine);

  ToolPose nominal(const Position& at) const;
  /// By (1) and (2).
  ToolPose actual(const Position& at) const;
  Vec3 actual_tip_mm(const Position& at) const;
  /// actual - nominal of the tip [mm], in the workpiece frame.
  Vec3 tip_error_mm(const Position& at) const;
  /// By (4).
  Vec3 tip_error_first_order_mm(const Position& at) const;
  /// No less than the second derivative of (4) along any straight way [1/mm], rotary axes
  /// at 0 and each linear axis within +-`reach_mm`:
  ///
  ///     |e''| <= sum |d''| + |r''| |P - p| + 2 |r'|                                  (5)
  double bend_at_most(const Vec3& reach_mm) const;
  /// One for each axis of the chain, from the bed to the tool, then to the workpiece.
  std::vector<AxisEffect> effects(const Position& at) const;

 private:
  /// Six errors of one axis, machine.hpp (1): by power, then direction.
  struct Polynomial {
    std::array<std::array<double, kDirections>, 4> c{};
    std::array<double, kDirections> b{};
    std::vector<std::array<std::array<double, kDirections>, 2>> f;  // a_h and d_h
    std::array<double, kDirections> at(double q, double t, double sign) const;
  };
  struct Joint {
    std::size_t axis;  // place in kLetters
    double sigma, inverse_Q;
    Vec3 p, location;            // location: of a rotary axis
    Vec3 travel{};               // u of a linear axis
    std::array<Turn, 3> tilt{};  // EA0, EB0, EC0 of a rotary axis
    Polynomial errors{};
    Polynomial small{};  // R_i^T d_i and R_i^T r_i of (4): errors with what is constant
  };
  template <bool kDirection>
  ToolPose pose(const Position& at) const;

  std::vector<Joint> tool_, work_;  // each from the bed outwards
  Vec3 tool_point_;
};

}  // namespace turnwright::volumetric
