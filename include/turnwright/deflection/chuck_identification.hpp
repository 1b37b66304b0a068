#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "turnwright/deflection/response.hpp"

/// Identification of the chuck's compliance from test cuts, see docs/chuck.md.
namespace turnwright::deflection {

enum class Plane { radial, tangential };

/// One test cut in one plane: the force F [N] and its couple C [N mm] at z = `z_mm`, and
/// the deflection of the root alone (without part and tool) there, up to a constant of
/// its setup.
struct PlaneTest {
  std::string setup;
  double z_mm = 0, F_N = 0, C_Nmm = 0;
  double y_mm = 0;
};

/// A measured cut: the radius error of an outside surface of diameter D, the known
/// deflections of part and tool, and optionally the tangential deflection seen by a
/// probe.
struct TestCut {
  std::string setup;
  double z_mm = 0, D_mm = 0;
  Load load;
  double radius_error_mm = 0;
  double tool_mm = 0;  ///< the part of tool and slide in the radius error
  Flexibility part;    ///< of the part at z on a rigid root, the same in both planes
  std::optional<double> delta_t_mm;
};

/// The cut in the radial plane, with C = -Fa D/2:
///     y = e - f_ww Fr - f_wp C - tool - delta_t^2/D                              (1)
/// where delta_t = (f_ww + t0 + 2 t1 z + t2 z^2) Ft for the tangential root t.
PlaneTest radial_test(const TestCut& cut, const Root& tangential);
/// The cut in the tangential plane, with C = 0: y = delta_t - f_ww Ft.
/// @throws std::domain_error if delta_t was not measured.
PlaneTest tangential_test(const TestCut& cut);

/// A further cut that would determine the compliance.
struct MissingTest {
  enum class Kind { force, position, couple };
  Kind kind = Kind::force;
  std::string setup;
  int ordinal = 2;  ///< number of this force, position or couple in the setup, from 1
};
/// "a cut at another force in setup A", "a cut at a third z in setup A", ...
std::string words(const MissingTest& missing);

/// A change of the parameters that has no effect on any cut of the design.
struct NullDirection {
  /// Of c0, c1 Z and c2 Z^2, Z = the largest |z|; the largest is 1.
  std::array<double, 3> weight{};
  bool moves_offsets = false;  ///< setups' offsets change along with it
};
/// "c0 with the setups' offsets", "c1 with c2", "c2".
std::string words(const NullDirection& direction);

/// What a set of cuts can determine, for any values that are measured.
struct Identifiability {
  int rank = 0;          ///< of 3: c0, c1, c2 beside a free offset for each setup
  double condition = 0;  ///< largest over smallest singular value, 0 where rank < 3
  std::vector<NullDirection> null_directions;
  std::vector<MissingTest> missing;  ///< with all of them the rank is 3
  /// Setups whose cuts all have the same force, and so say nothing about c0.
  std::vector<std::string> one_force;
  long degrees_of_freedom = 0;  ///< cuts less parameters less setups
  /// Largest standard error of the predicted deflection over the cuts, per unit standard
  /// deviation of a measurement; 0 where rank < 3.
  double largest_u = 0;
  /// The cut that reduces largest_u most.
  MissingTest most_useful;
};

/// Rank of the design X with rows
///
///     x = (F, 2 z F + C, z^2 F + z C)                                            (2)
///
/// less their means over each setup, because the offset of a setup is free.  A setup with
/// a single force has F - mean(F) = 0, so its c0 cannot be separated from its offset.
/// Singular values below 1e-6, in units of the largest force and |z| and divided by the
/// root of the number of cuts, count as zero: forces typed to six digits that differ in
/// the last one are the same force.
/// Missing tests are found by trial: copies of the cuts at twice the force, at another z,
/// or with another couple, in this order; the first that raises the rank is named.
/// Degenerate input: without cuts the rank is 0 and no test is named.
Identifiability identifiability(std::span<const PlaneTest> tests, Plane plane);

/// The identified root in one plane.
struct PlaneFit {
  Root root;
  /// Covariance of (c0, c1, c2); on the border of the elastic roots it is that of the
  /// unconstrained fit, which is on the safe side (see identify).
  std::array<std::array<double, 3>, 3> covariance{};
  struct Offset {
    std::string setup;
    double mm = 0, u_mm = 0;
  };
  std::vector<Offset> offsets;      ///< in order of first appearance; none for a setup
                                    ///< that has only outliers
  std::vector<double> residual_mm;  ///< of all tests, outliers included
  std::vector<std::size_t> outliers;
  double s_mm = 0;  ///< standard deviation of one measurement, outliers left out
  long degrees_of_freedom = 0;
  bool on_border = false;  ///< the best elastic root has c1^2 = c0 c2
  Root unconstrained;      ///< best of all symmetric S, elastic or not
  /// Excess of the elastic root's sum of squares over the best one, in units of s^2.
  /// Above 9 the measurements contradict every elastic chuck (drift, wrong forces, a
  /// wrong part).
  double contradiction = 0;
};

/// Robust least squares for y = x . (c0, c1, c2) + offset of the setup, Eq. (2).
///
/// The fit starts from least trimmed squares, which tolerates that a third of the cuts
/// beyond the unknowns are wrong.  The scale is the median |residual| times
/// 1.4826 (1 + 5/(n - unknowns)).  Then Tukey's loss (4.685 scales) is minimised by
/// reweighting, and finally ordinary least squares over the cuts within kOutlier standard
/// deviations, repeated until this set does not change: a cut is either used in full or
/// named as an outlier.  Where the cuts used do not determine the compliance, all are
/// used.
///
/// S = L L^T with L lower triangular is never indefinite.  The loss is convex in S and
/// the elastic S are a convex cone.  If the best of all S is elastic, it is the answer.
/// Otherwise the best elastic S lies on the border, where L = (a, b)^T has one column; it
/// is found by a search over all angles of (a, b), for each of which the length is a
/// linear problem.  (Steps in L itself would stall at L = 0.)  The projection onto a
/// convex cone in the metric of the least squares never increases the distance of two
/// points, so the errors on the border are at most those of the unconstrained covariance
/// s^2 (X^T X)^-1.
/// @throws std::domain_error if the rank is not 3, no degree of freedom is left, or a
/// value is not finite.
PlaneFit identify(std::span<const PlaneTest> tests, Plane plane);

inline constexpr double kOutlier = 4;  ///< standard deviations; larger keeps more cuts

/// A value with its standard error.
struct Estimate {
  double value = 0, u = 0;
};

/// Deflection of the root at z under F and C [mm], x . c, with its standard error
/// (x^T cov x)^(1/2).
Estimate predicted_deflection(const PlaneFit& fit, double z_mm, double F_N, double C_Nmm);

/// Radius error by the root's deflection, delta_r + delta_t^2/D; without a tangential fit
/// the second term is 0.  The errors of the two planes are independent.
Estimate predicted_radius_error(const PlaneFit& radial, const PlaneFit* tangential,
                                double z_mm, double D_mm, const Load& load);

/// The three springs of [Valino 2008], c0 = 1/k1 + Lc^2/k2, c1 = Lc/k2,
/// c2 = 1/k2 + 1/k3, as flexibilities, so that a rigid spring is 0.
struct Springs {
  double Lc_mm = 0;
  double per_k1_mm_N = 0, per_k2_rad_Nmm = 0, per_k3_rad_Nmm = 0;
};

/// The arms Lc for which no spring is negative, [c1/c2, c0/c1]; nothing if c1 <= 0 or S
/// is not elastic.  S has three numbers, the springs with Lc four; so every Lc in this
/// range is equally good.
struct ArmRange {
  double least_mm = 0, largest_mm = 0;
};
std::optional<ArmRange> arms(const Root& root);

/// The springs for an arm; nothing outside arms(), up to a rounding of 1e-9.
std::optional<Springs> springs(const Root& root, double Lc_mm);

/// Standard errors of the three flexibilities for a given arm.  They are linear in
/// (c0, c1, c2); with the fit's covariance v the error of 1/k1 = c0 - Lc c1, for example,
/// is (v0 - 2 Lc v01 + Lc^2 v1)^(1/2).
Springs spring_errors(const PlaneFit& fit, double Lc_mm);

}  // namespace turnwright::deflection
