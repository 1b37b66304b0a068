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

/// The letters of the axes and of the directions of their errors, in the order in which
/// all arrays hold them.
inline constexpr std::string_view kLetters = "XYZABC";
inline constexpr std::size_t kDirections = kLetters.size();

constexpr bool is_rotary(char axis) { return axis >= 'A' && axis <= 'C'; }
/// Index of a letter in kLetters; npos for any other letter.
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
/// -1 is the sign of the programmed motion dq/dt, 0 at rest or where it is unknown; h =
/// 1, 2, .. for rotary axes only.  b is half the reversal value: lost motion B = -2 b.
struct ErrorFunction {
  std::array<double, 4> c{};
  double b = 0;
  std::vector<Harmonic> f = {};
};

struct Axis {
  char name = 'X';
  /// Reference point at q = 0, moving with the axis: linear errors are those of this
  /// point [mm].
  Vec3 p_mm{};
  double Q = 0;  ///< reference travel [mm or rad]; default_Q unless set
  std::array<ErrorFunction, kDirections> errors{};
  /// Rotary axes: EX0, EY0, EZ0 [mm], EA0, EB0, EC0 [rad], the location of the axis line.
  /// Linear axes: the two of EA0, EB0, EC0 about directions across the axis, which are
  /// its squareness; the others are 0.
  std::array<double, kDirections> location{};
};

/// Default reference travel: 100 mm of a linear axis, pi of a rotary one.
constexpr double default_Q(char axis) { return is_rotary(axis) ? units::kPi : 100.0; }

/// Kinematic chain from workpiece `w` over the bed `f` to the tool `t`, for example
/// wfXYZt, wCfZXt (a lathe), wCBXfZYt.  At q = 0 all frames coincide with the machine's.
struct KinematicChain {
  std::string chain;
  Vec3 tool_point_mm{};    ///< the tip at q = 0
  std::vector<Axis> axes;  ///< one for each letter of the chain, in any order
};

/// The calibrated geometric errors of a lathe.
struct GeometricErrors {
  KinematicChain chain;   ///< with X, Z and C; the tool stands at +X
  double jaws_z_mm = 0;   ///< end of the jaws; between centres the headstock centre
  double relative_u = 0;  ///< standard uncertainty of each error, as share of its value
  /// Further standard uncertainties of single errors, by name; p_mm and Q as in `chain`.
  std::vector<Axis> u = {};
};

}  // namespace turnwright::catalogue
