#pragma once
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "turnwright/base/units.hpp"

/// A machine's geometric errors as values [mm, rad], named as in ISO 230-1: E_{alpha
/// beta} is the error in direction alpha (X Y Z shifts, A B C rotations about them) of
/// the motion of axis beta.  Errors are physical motions of the body farther from the
/// bed.
namespace turnwright::catalogue {

using Vec3 = std::array<double, 3>;

/// The axes' letters, and the directions of their errors, in the order of all arrays.
inline constexpr std::string_view kLetters = "XYZABC";
inline constexpr std::size_t kDirections = kLetters.size();

constexpr bool is_rotary(char axis) { return axis >= 'A' && axis <= 'C'; }
/// Place of a letter of kLetters; npos for any other.
constexpr std::size_t letter_index(char letter) { return kLetters.find(letter); }

/// One harmonic a cos(h q) + d sin(h q) of a rotary axis.
struct Harmonic {
  double a = 0, d = 0;
};

/// One error along the travel of its axis:
///
///     E(q, s) = c0 + c1 t + c2 t^2 + c3 t^3 + b s + sum_h (a_h cos hq + d_h sin hq)  (1)
///
/// t = q/Q with the axis' reference travel Q; q the programmed value [mm or rad]; s = +1,
/// -1 the sign of the programmed motion dq/dt, 0 where it is unknown or at rest; h = 1,
/// 2, .., rotary axes only.  b is half the reversal: lost motion B = -2 b.
struct ErrorFunction {
  std::array<double, 4> c{};
  double b = 0;
  std::vector<Harmonic> f = {};
};

struct Axis {
  char name = 'X';
  /// Reference point, moving with the axis: shifts are errors there [mm], at q = 0.
  Vec3 p_mm{};
  double Q = 0;  ///< [mm or rad]; default_Q unless set
  std::array<ErrorFunction, kDirections> errors{};
  /// Rotary axes: EX0, EY0, EZ0 [mm], EA0, EB0, EC0 [rad], the place of the axis line.
  /// Linear axes: of EA0, EB0, EC0 the two across the axis, its squareness; others 0.
  std::array<double, kDirections> location{};
};

/// 100 mm of a linear axis, pi of a rotary one.
constexpr double default_Q(char axis) { return is_rotary(axis) ? units::kPi : 100.0; }

/// Kinematic chain from workpiece `w` over the bed `f` to the tool `t`, for example
/// wfXYZt, wCfZXt (a lathe), wCBXfZYt.  At q = 0 all frames coincide with the machine's.
struct KinematicChain {
  std::string chain;
  Vec3 tool_point_mm{};    ///< the tip at q = 0
  std::vector<Axis> axes;  ///< one for each letter of the chain, in any order
};

/// A lathe's geometric errors as calibrated.
struct GeometricErrors {
  KinematicChain chain;   ///< with X, Z and C; the tool stands at +X
  double jaws_z_mm = 0;   ///< where the jaws end, between centres the headstock's centre
  double relative_u = 0;  ///< standard uncertainty of each error, of its value
  /// Standard uncertainties besides, by the errors' own names; p_mm and Q as in `chain`.
  std::vector<Axis> u = {};
};

}  // namespace turnwright::catalogue
