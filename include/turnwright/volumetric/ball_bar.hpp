#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "turnwright/volumetric/machine.hpp"

/// Circular tests with a telescoping ball bar (ISO 230-4), simulated and analysed.
///
/// In the plane UV (XY, YZ or ZX) the tool ball runs on
///
///     q = centre + R (u cos theta + v sin theta),  theta_k = theta0 + 2 pi k/n       (1)
///
/// counter-clockwise (dir = +1) and clockwise (-1), the third axis at rest; the
/// signs of motion are s_U = -dir sgn(sin theta), s_V = dir sgn(cos theta), |sin| and
/// |cos| below 1e-12 counting as 0.  A value is the bar's length less R, both paths by
/// the same angles.
namespace turnwright::volumetric {

enum class Plane { XY, YZ, ZX };
/// {'X', 'Y'}, {'Y', 'Z'}, {'Z', 'X'}.
std::array<char, 2> axes_of(Plane plane);

struct BallBarTest {
  Plane plane = Plane::XY;
  double R_mm = 150;
  std::size_t n = 72;
  /// pi/n unless given: for n divisible by 4 no point lies where an axis reverses.
  std::optional<double> theta0_rad = {};
  std::vector<double> theta_rad = {};  ///< if any: the angles instead of n and theta0
  Vec3 centre_mm{};                    ///< where X, Y, Z stand at the circle's centre
  /// Of the workpiece ball from the nominal centre, in the workpiece frame.
  Vec3 centre_offset_mm{};
};

struct Trace {
  Plane plane = Plane::XY;
  double R_mm = 150;
  std::vector<double> theta_rad, ccw_mm, cw_mm;
};

/// |tip - nominal tip at the centre - o| - R in the workpiece frame, the tool point at
/// the origin at q = 0 whatever the machine says.
/// @throws std::domain_error as Kinematics, if there are no angles, R is not > 0, or the
///   chain lacks an axis of the plane.
Trace simulate(const Machine& machine, const BallBarTest& test);

/// Circles are least squares on D + e_u cos + e_v sin [mm].
struct Iso230_4 {
  double G_ccw_mm = 0, G_cw_mm = 0;        ///< range of a path about its own circle
  double G_ccw_mz_mm = 0, G_cw_mz_mm = 0;  ///< the least range over e_u, e_v
  double G_bi_mm = 0;                      ///< both paths about their common circle
  double H_mm = 0;                         ///< largest |ccw - cw| at equal theta
  double F_max_mm = 0, F_min_mm = 0;       ///< extremes about the common centre, D kept
  double D_mm = 0;                         ///< the common circle's mean radial deviation
};
/// @throws std::domain_error if the trace's lists are empty or differ in length.
Iso230_4 iso230_4(const Trace& trace);

/// Terms of the decomposition, in the order of all its arrays; centre and reversals [mm],
/// EVU2, EUV2 [mm per (100 mm)^2], square [rad].
inline constexpr std::array<std::string_view, 12> kBallBarTerms = {
    "centre_u", "centre_v", "scale_u", "scale_v", "square", "EUUb",
    "EVVb",     "EVUb",     "EUVb",    "EVU2",    "EUV2",   "servo"};

/// What one effect does to the trace by itself.
struct Contribution {
  std::string name;  ///< "backlash_u", "squareness", ..
  double range_mm = 0;
};

struct BallBarFit {
  std::array<double, kBallBarTerms.size()> value{}, u{};  ///< with standard uncertainty
  double rms_mm = 0;                                      ///< of what the fit leaves
  std::vector<Contribution> ranking;                      ///< largest first
};

/// Both paths together, unweighted, c = cos theta, s = sin theta, Q = 100 mm:
///
///     v = centre_u c + centre_v s + R scale_u c^2 + R scale_v s^2 + R square s c
///         - EUUb dir sgn(s) c + EVVb dir sgn(c) s - EVUb dir |s| + EUVb dir |c|
///         + EVU2 (R/Q)^2 c^2 s + EUV2 (R/Q)^2 s^2 c + 2 servo dir s c                (2)
///
/// Coefficients are relative, tool minus workpiece; centre = -o.  square = u_U . u_V: the
/// angle from +U to +V is 90 deg - square.  Uncertainties: s^2 (A^T A)^-1 with s^2 = sum
/// of squared residuals/(values - 12).
///
/// (2) is the tip's first-order error along the bar.  It confounds what kConfounded
/// lists: a trace cannot tell such terms apart, whatever its length.
/// @throws ModelRangeError if the angles do not tell the twelve terms apart.
BallBarFit decompose(const Trace& trace);

/// Eq. (2) at an angle of a path, dir = +1 counter-clockwise [mm].
double fitted_mm(const BallBarFit& fit, double R_mm, double theta_rad, double dir);

/// Sentences on what one circle cannot separate.
std::vector<std::string> confounded(Plane plane);

}  // namespace turnwright::volumetric
