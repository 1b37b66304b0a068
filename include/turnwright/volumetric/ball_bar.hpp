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
/// counter-clockwise (dir = +1) and clockwise (-1), with the third axis at rest.  The
/// signs of motion are s_U = -dir sgn(sin theta), s_V = dir sgn(cos theta), where |sin|
/// and |cos| below 1e-12 count as 0.  A value is the length of the bar less R; both paths
/// have the same angles.
namespace turnwright::volumetric {

enum class Plane { XY, YZ, ZX };
/// {'X', 'Y'}, {'Y', 'Z'}, {'Z', 'X'}.
std::array<char, 2> axes_of(Plane plane);

struct BallBarTest {
  Plane plane = Plane::XY;
  double R_mm = 150;
  std::size_t n = 72;
  /// Default pi/n: for n divisible by 4 no point then lies where an axis reverses.
  std::optional<double> theta0_rad = {};
  std::vector<double> theta_rad = {};  ///< unless empty: the angles, instead of n, theta0
  Vec3 centre_mm{};                    ///< positions of X, Y, Z at the circle's centre
  /// Offset of the workpiece ball from the nominal centre, in the workpiece frame.
  Vec3 centre_offset_mm{};
};

struct Trace {
  Plane plane = Plane::XY;
  double R_mm = 150;
  std::vector<double> theta_rad, ccw_mm, cw_mm;
};

/// Simulated trace: |tip - nominal tip at the centre - o| - R in the workpiece frame.
/// The tool point is taken at the origin at q = 0, whatever the machine's document has.
/// @throws std::domain_error as Kinematics, if there are no angles, R is not > 0, or the
///   chain lacks an axis of the plane.
Trace simulate(const Machine& machine, const BallBarTest& test);

/// Values of ISO 230-4; circles are least-squares fits of D + e_u cos + e_v sin [mm].
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

/// Terms of the decomposition in the order of all its arrays: centre and reversals in mm,
/// EVU2 and EUV2 in mm per (100 mm)^2, square in rad.
inline constexpr std::array<std::string_view, 12> kBallBarTerms = {
    "centre_u", "centre_v", "scale_u", "scale_v", "square", "EUUb",
    "EVVb",     "EVUb",     "EUVb",    "EVU2",    "EUV2",   "servo"};

/// Effect of one cause by itself on the trace.
struct Contribution {
  std::string name;  ///< "backlash_u", "squareness", ..
  double range_mm = 0;
};

struct BallBarFit {
  std::array<double, kBallBarTerms.size()> value{}, u{};  ///< with standard uncertainty
  double rms_mm = 0;                                      ///< of the residuals
  std::vector<Contribution> ranking;                      ///< largest first
};

/// Decomposition of a trace into the causes of its deviations, by an unweighted fit to
/// both paths together.  v(theta) is the deviation of the bar's length R, dir = +1 on the
/// counter-clockwise path and -1 on the other; c = cos theta, s = sin theta, Q = 100 mm:
///
///     v = centre_u c + centre_v s + R scale_u c^2 + R scale_v s^2 + R square s c
///         - EUUb dir sgn(s) c + EVVb dir sgn(c) s - EVUb dir |s| + EUVb dir |c|
///         + EVU2 (R/Q)^2 c^2 s + EUV2 (R/Q)^2 s^2 c + 2 servo dir s c                (2)
///
/// scale: scale errors of the axes U and V; EUUb, EVVb, EVUb, EUVb: their errors of
/// reversal; EVU2, EUV2: curvature of their ways; servo: mismatch of their following.
/// Coefficients are relative, tool minus workpiece; the centre is the negative of the
/// pivot's offset o.  square = u_U . u_V, so
/// the angle from +U to +V is 90 deg - square.  Uncertainties follow from s^2 (A^T A)^-1
/// with s^2 = sum of squared residuals/(values - 12).
///
/// (2) is the tip's first-order error along the bar.  The effects listed by confounded()
/// cannot be separated by one circle, however many points it has.
/// @throws ModelRangeError if the angles do not separate the twelve terms.
BallBarFit decompose(const Trace& trace);

/// The fitted trace (2) [mm] at an angle of a path; dir = +1 is counter-clockwise.
double fitted_mm(const BallBarFit& fit, double R_mm, double theta_rad, double dir);

/// Sentences that name the effects that one circle cannot separate.
std::vector<std::string> confounded(Plane plane);

}  // namespace turnwright::volumetric
