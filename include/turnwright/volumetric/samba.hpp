#pragma once
#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "turnwright/volumetric/machine.hpp"

/// Five-axis calibration by probing uncalibrated balls (SAMBA) and a facet (TANGO) on the
/// table of a wCBXfZYt machine, enriched by one scale bar.
namespace turnwright::volumetric {

/// One pose of the rotary axes and what is probed there: balls first, then the facet
/// once for each pre-move.
struct Indexation {
  double B_rad = 0, C_rad = 0;
  std::vector<std::size_t> balls;  ///< places in SambaStrategy::balls_mm
  /// Signs of the last motion of the two axes across the probing direction, in the order
  /// X Y Z; the probing axis itself moves against the facet's normal.
  std::vector<std::array<double, 2>> pre_moves;
};

struct SambaStrategy {
  std::vector<Indexation> indexations;
  std::vector<Vec3> balls_mm;  ///< in the workpiece frame, nominal
  Vec3 facet_mm{}, facet_normal{1, 0, 0};
  double scale_bar_mm = 0;                          ///< its calibrated length
  std::array<std::size_t, 2> scale_bar_ends{0, 1};  ///< the balls it holds
  /// Tips used, from the point that q = 0 brings to the origin; every probing is done
  /// with each in turn.  Their distances from each other are known.
  std::vector<Vec3> styli_mm{Vec3{}};
};

/// Parameters of `all`: eight axis locations, linear scales, quadratic and cubic
/// positioning and straightness, linear to cubic angular errors, reversals, linear to
/// cubic errors of both rotary axes, and the facet's distance: 102 names.
const std::vector<std::string>& samba_parameters();

/// Whether `name` is one: "facet", E and a direction with 0 and the axis (EC0Y, EX0C; a
/// linear axis has the two turns across it), or with the axis and 1, 2, 3 for the
/// polynomial (EXX1, EAZ3) or b for the reversal of a linear axis' shifts (EYXb).
bool is_samba_parameter(const std::string& name);

/// A direction in the space of unknowns that no reading sees: name -> component [mm, rad
/// times 100 mm], of unit length.
using NullVector = std::map<std::string, double>;

struct Identifiability {
  std::vector<std::string> unknowns;  ///< the parameters asked for, then the set-up's
  std::size_t parameters = 0;         ///< how many of them are parameters
  std::size_t equations = 0, rank = 0;
  double condition = 0;  ///< largest singular value over the smallest that counts
  std::vector<bool> identifiable;  ///< by unknown
  std::vector<NullVector> null_vectors;
};

/// What a strategy can find.  Each ball gives three equations, each touch of the facet
/// and the scale bar one:
///
///     reading = e + R_fw^T tip - ball                                                (1)
///     touch = n . (e + R_fw^T tip) - facet                                           (2)
///     L_true - L_nominal = u . (ball_2 - ball_1)                                     (3)
///
/// e is the first-order tip error (kinematics.hpp (4)) at the nominal position, linear in
/// the parameters; tip, the balls and the facet are unknown offsets of the set-up
/// [mm].  All in the workpiece frame, tool minus workpiece.  Signs of motion are unknown
/// (0) where balls are probed: their centres are means of touches from all sides.
///
/// The facet's distance (with the radius of the tip) is an unknown only if it is among
/// the parameters; without it EXXb, EYYb, EZZb are found as if it were calibrated.
///
/// Columns of angles are divided by 100 mm; singular values below kRankTolerance of the
/// largest count as zero.  An unknown is identifiable if no null vector moves it.
/// Source: [Mayer 2012], the method as [Mohammed 2019] describes it; equations derived
/// here.
/// @throws std::domain_error for unknown or repeated names, or a ball or stylus that is
///   not there; ModelRangeError where equations times unknowns are over 10 million, here
///   and below.
Identifiability identifiability(const SambaStrategy& strategy,
                                const std::vector<std::string>& parameters);

/// Between what rounding leaves (1e-16) and C = 3 B of the thesis' strategy leaves of
/// eight directions (9e-8) on one side, what it does find (1.4e-6) on the other.
inline constexpr double kRankTolerance = 3e-7;

struct SambaFit {
  Identifiability of;
  std::vector<double> value, u;  ///< by unknown; 0 where it is not identifiable
  double s0_mm = 0;              ///< root of the residuals' squares by degrees of freedom
  std::size_t dof = 0;
};

/// Least squares of (1) to (3).  u is `noise_mm`, else s0, times the root of the
/// diagonal of the cofactor matrix.
/// @param readings_mm  per probing in the order of the strategy (indexations, then styli,
///   then balls and touches): three values of a ball, one of a touch, end to end.
/// @throws std::domain_error if there are not as many readings as (1) and (2) want.
SambaFit samba_fit(const SambaStrategy& strategy,
                   const std::vector<std::string>& parameters,
                   const std::vector<double>& readings_mm,
                   std::optional<double> noise_mm = {});

/// The readings (1), (2) that errors would give: name -> value, others 0.
std::vector<double> samba_readings(const SambaStrategy& strategy,
                                   const std::map<std::string, double>& errors);

/// The chain whose parameters are found.
inline constexpr std::string_view kSambaChain = "wCBXfZYt";

/// The readings that a machine of that chain gives by its exact kinematics, balls, tip
/// and facet in their nominal places.
std::vector<double> samba_readings(const SambaStrategy& strategy, const Machine& machine);

/// A change of the strategy and what it would find.
struct Remedy {
  std::string what;
  std::size_t rank = 0;
  std::vector<std::string> gains;  ///< parameters that become identifiable
};

/// Of C decoupled from B, a second stylus length as well, a star of three tips as well:
/// those that raise the rank, tried out one after the other.
std::vector<Remedy> remedies(const SambaStrategy& strategy, const Identifiability& found);

/// R_fw of an indexation: column by column, workpiece to machine axes.
std::array<double, 9> table_rotation(const Indexation& at);

}  // namespace turnwright::volumetric
