#pragma once
#include <array>
#include <vector>

#include "turnwright/volumetric/machine.hpp"

namespace turnwright::volumetric {

/// Programmed positions [mm, rad] and signs of motion, in the order of kLetters; those of
/// axes that are not in the chain are ignored.
struct Position {
  std::array<double, kDirections> q{};
  std::array<double, kDirections> sign{};
};

/// Tip [mm] and direction of the tool's axis in the workpiece frame.
struct ToolPose {
  Vec3 tip_mm{};
  Vec3 direction{0, 0, 1};  ///< (0, 0, 1) at q = 0
};

/// First-order effect of the errors of one axis on the tip, in the workpiece frame: the
/// columns of d tip/d(EX, EY, EZ, EA, EB, EC) [mm/mm, mm/rad].  The location errors of a
/// rotary axis act by the same columns.
struct AxisEffect {
  char axis = 'X';
  std::array<Vec3, kDirections> error{};
  /// For a linear axis the effect of EA0, EB0, EC0 [mm/rad]; the one along the axis is 0.
  std::array<Vec3, 3> squareness{};
};

/// A rotation by an angle, given by its cosine and sine.
struct Turn {
  double cos = 1, sin = 0;
};

/// A machine's kinematic chain, prepared for evaluation at many positions.
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
/// with P the nominal tip, R_i the nominal rotation of the joints between the bed and
/// joint i, and p_i the reference point of joint i, moved by these joints and, if joint i
/// is linear, by its own travel.
///
/// Valid for rigid bodies.  (4) neglects products of errors, 0.01 um for 100 urad over a
/// lever of 1 m; the difference falls by a factor of four when the errors are halved.
/// Source: products of homogeneous transformations in the zero-position form, derived
/// here; checked against dual quaternions in kinematics_test.
class Kinematics {
 public:
  /// @throws std::domain_error if the chain is invalid (chain_fault), its axes are not
  ///   those of the machine, a Q is not > 0, or an axis has errors that do not apply to
  ///   it.
  explicit Kinematics(const Machine& machine);

  ToolPose nominal(const Position& at) const;
  /// The exact pose, by (1) and (2).
  ToolPose actual(const Position& at) const;
  Vec3 actual_tip_mm(const Position& at) const;
  /// actual - nominal of the tip [mm], in the workpiece frame.
  Vec3 tip_error_mm(const Position& at) const;
  /// The same to first order, by (4).
  Vec3 tip_error_first_order_mm(const Position& at) const;
  /// Upper bound of the second derivative of (4) along any straight path [1/mm], with
  /// rotary axes at 0 and each linear axis within +-`reach_mm`:
  ///
  ///     |e''| <= sum |d''| + |r''| |P - p| + 2 |r'|                                  (5)
  double bend_at_most(const Vec3& reach_mm) const;
  /// The effects of all axes of the chain, from the bed to the tool, then to the
  /// workpiece.
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
    Polynomial small{};  // R_i^T d_i and R_i^T r_i of (4), constants included
  };
  template <bool kDirection>
  ToolPose pose(const Position& at) const;

  std::vector<Joint> tool_, work_;  // each from the bed outwards
  Vec3 tool_point_;
};

}  // namespace turnwright::volumetric
