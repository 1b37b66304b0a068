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

/// One pose of the rotary axes with its probings: first the balls, then the facet once
/// for each pre-move.
struct Indexation {
  double B_rad = 0, C_rad = 0;
  std::vector<std::size_t> balls;  ///< indices in SambaStrategy::balls_mm
  /// Signs of the last motion of the two axes across the probing direction, in the order
  /// X Y Z; the probing axis, that nearest to the facet's normal in this pose, of equally
  /// near ones the first, itself moves against the normal.
  std::vector<std::array<double, 2>> pre_moves;
};

struct SambaStrategy {
  std::vector<Indexation> indexations;
  std::vector<Vec3> balls_mm;  ///< in the workpiece frame, nominal
  Vec3 facet_mm{}, facet_normal{1, 0, 0};
  double scale_bar_mm = 0;                          ///< its calibrated length
  std::array<std::size_t, 2> scale_bar_ends{0, 1};  ///< the balls it holds
  /// Positions of the tips, from the point that is at the origin at q = 0; every probing
  /// is done with each of them.  Their distances from each other are known.
  std::vector<Vec3> styli_mm{Vec3{}};
};

/// Parameters of `all`: eight axis locations, linear scales, quadratic and cubic
/// positioning and straightness, linear to cubic angular errors, reversals, linear to
/// cubic errors of both rotary axes, and the facet's distance: 102 names.
const std::vector<std::string>& samba_parameters();

/// Whether `name` is a parameter: "facet"; E and a direction with 0 and the axis (EC0Y,
/// EX0C; a linear axis has the two rotations across it); or E and a direction with the
/// axis and 1, 2, 3 for the polynomial (EXX1, EAZ3) or b for the reversal of a linear
/// axis' shifts (EYXb).
bool is_samba_parameter(const std::string& name);

/// How large the equations (1) to (3) below are.
struct SambaSize {
  std::size_t equations = 0, unknowns = 0;
  /// Whether equations times the square of the unknowns are at most kMostSambaWork.
  bool solvable() const;
};

/// The largest work of one solution, some three times as many operations: two seconds.
inline constexpr double kMostSambaWork = 4e9;

SambaSize samba_size(const SambaStrategy& strategy,
                     const std::vector<std::string>& parameters);

/// A direction of unit length in the space of unknowns that changes no reading: name ->
/// component [mm, rad times 100 mm].
using NullVector = std::map<std::string, double>;

struct Identifiability {
  std::vector<std::string> unknowns;  ///< the requested parameters, then the set-up's
  std::size_t parameters = 0;         ///< the number of parameters among them
  std::size_t equations = 0, rank = 0;
  double condition = 0;  ///< largest singular value over the smallest that is not zero
  std::vector<bool> identifiable;  ///< by unknown
  std::vector<NullVector> null_vectors;
};

/// The parameters that a strategy can determine.  Each ball gives three equations, each
/// touch of the facet and the scale bar one:
///
///     reading = e + R_fw^T tip - ball                                                (1)
///     touch = n . (e + R_fw^T tip) - facet                                           (2)
///     L_true - L_nominal = u . (ball_2 - ball_1)                                     (3)
///
/// e is the first-order tip error (kinematics.hpp (4)) at the nominal position, linear in
/// the parameters; tip, balls and facet are unknown offsets of the set-up [mm].  All
/// values are in the workpiece frame, tool minus workpiece.  Signs of motion are 0
/// (unknown) where balls are probed, because their centres are means of touches from all
/// sides.
///
/// The facet's distance (with the radius of the tip) is an unknown only if it is among
/// the parameters; otherwise EXXb, EYYb, EZZb are found as if it were calibrated.
///
/// Columns of angles are divided by 100 mm; singular values below kRankTolerance of the
/// largest count as zero.  An unknown is identifiable if no null vector changes it.
/// Source: [Mayer 2012], the method as [Mohammed 2019] describes it; equations derived
/// here.
/// @throws std::domain_error for unknown or repeated names, or a missing ball or stylus;
///   ModelRangeError where the equations are not solvable(); Cancelled; here and below.
Identifiability identifiability(const SambaStrategy& strategy,
                                const std::vector<std::string>& parameters);

/// Between values that count as zero (rounding 1e-16; eight directions of the strategy of
/// [Mohammed 2019], C = 3 B, 9e-8) and the least that this strategy does find (1.4e-6).
inline constexpr double kRankTolerance = 3e-7;

struct SambaFit {
  Identifiability of;
  std::vector<double> value, u;  ///< by unknown; 0 where it is not identifiable
  double s0_mm = 0;              ///< root of the sum of squared residuals over dof
  std::size_t dof = 0;
};

/// Least-squares solution of (1) to (3).  u is `noise_mm`, or s0 if that is not given,
/// times the root of the diagonal of the cofactor matrix.  The length of the scale bar (3)
/// counts as one reading with the same noise.
/// @param readings_mm  one after the other in the order of the strategy (indexations,
///   then styli, then balls and touches): three values for a ball, one for a touch.
/// @throws std::domain_error if the number of readings is not that of (1) and (2).
SambaFit samba_fit(const SambaStrategy& strategy,
                   const std::vector<std::string>& parameters,
                   const std::vector<double>& readings_mm,
                   std::optional<double> noise_mm = {});

/// The readings (1), (2) for given errors (name -> value, all others 0).
std::vector<double> samba_readings(const SambaStrategy& strategy,
                                   const std::map<std::string, double>& errors);

/// The kinematic chain to which the parameters belong.
inline constexpr std::string_view kSambaChain = "wCBXfZYt";

/// The readings of a machine of that chain by its exact kinematics, with balls, tip and
/// facet at their nominal positions.
std::vector<double> samba_readings(const SambaStrategy& strategy, const Machine& machine);

/// A change of the measuring strategy, and the error parameters that it would make
/// identifiable.
struct Remedy {
  std::string what;
  std::size_t rank = 0;
  std::vector<std::string> gains;  ///< parameters that become identifiable
};

/// The remedies that raise the rank.  They are tried one after the other, each in
/// addition to those before: C decoupled from B, a second stylus length, a star of three
/// tips.
std::vector<Remedy> remedies(const SambaStrategy& strategy, const Identifiability& found);

/// R_fw of an indexation, column by column, from workpiece to machine axes.
std::array<double, 9> table_rotation(const Indexation& at);

}  // namespace turnwright::volumetric
