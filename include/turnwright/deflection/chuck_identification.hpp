#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "turnwright/deflection/response.hpp"

/// The chuck's compliance from test cuts: docs/chuck.md.
namespace turnwright::deflection {

enum class Plane { radial, tangential };

/// What one test cut tells about one plane: the force F [N] there and its couple C
/// [N mm] at z = `z_mm`, and how far the root alone (no part, no tool) gave way there, up
/// to a constant of its setup.
struct PlaneTest {
  std::string setup;
  double z_mm = 0, F_N = 0, C_Nmm = 0;
  double y_mm = 0;
};

/// A cut as measured: the radius error of an outside surface of diameter D, what else
/// gave way known beforehand, and optionally the tangential deflection seen by a probe.
struct TestCut {
  std::string setup;
  double z_mm = 0, D_mm = 0;
  Load load;
  double radius_error_mm = 0;
  double tool_mm = 0;  ///< the tool's and slide's part of the radius error
  Flexibility part;    ///< of the part at z on a rigid root, the same in both planes
  std::optional<double> delta_t_mm;
};

/// The cut seen in the radial plane, with C = -Fa D/2:
///     y = e - f_ww Fr - f_wp C - tool - delta_t^2/D                              (1)
/// where delta_t = (f_ww + t0 + 2 t1 z + t2 z^2) Ft for the tangential root t.
PlaneTest radial_test(const TestCut& cut, const Root& tangential);
/// And in the tangential plane, C = 0: y = delta_t - f_ww Ft.
/// @throws std::domain_error if delta_t was not measured.
PlaneTest tangential_test(const TestCut& cut);

/// A cut that would tell more.
struct MissingTest {
  enum class Kind { force, position, couple };
  Kind kind = Kind::force;
  std::string setup;
  int ordinal = 2;  ///< the how many-th force, position or couple of the setup it is
};
/// "a cut at another force in setup A", "a cut at a third z in setup A", ...
std::string words(const MissingTest& missing);

/// A change of the parameters that no cut of the design sees.
struct NullDirection {
  /// Of c0, c1 Z and c2 Z^2, Z = the largest |z|; the largest is 1.
  std::array<double, 3> weight{};
  bool moves_offsets = false;  ///< setups' offsets change along with it
};
/// "c0 with the setups' offsets", "c1 with c2", "c2".
std::string words(const NullDirection& direction);

/// What a design can tell, whatever is measured.
struct Identifiability {
  int rank = 0;          ///< of 3: c0, c1, c2 beside a free offset for each setup
  double condition = 0;  ///< largest over smallest singular value, 0 where rank < 3
  std::vector<NullDirection> null_directions;
  std::vector<MissingTest> missing;  ///< one of each, in turn, makes the rank 3
  /// Setups whose cuts all have one force (they say nothing of c0).
  std::vector<std::string> one_force;
  long degrees_of_freedom = 0;  ///< cuts less parameters less setups
  /// Largest standard error of the predicted deflection over the cuts, per unit standard
  /// deviation of a measurement; 0 where rank < 3.
  double largest_u = 0;
  /// The cut that brings largest_u down most.
  MissingTest most_useful;
};

/// Rank of the design X with rows
///
///     x = (F, 2 z F + C, z^2 F + z C)                                            (2)
///
/// less their means over each setup, which is what a free offset leaves of them: a setup
/// with a single force has F - mean(F) = 0, so its c0 cannot be told from its offset.
/// In units of the largest force and |z| and over the root of the number of cuts,
/// singular values below 1e-6 count as none: forces typed to six digits that differ in
/// the last are one force.
/// Missing tests are found by trial: copies of the cuts at twice the force, at another z
/// or with another couple, the first that raises the rank, in that order.
/// Degenerate input: no cuts, rank 0 and nothing is named.
Identifiability identifiability(std::span<const PlaneTest> tests, Plane plane);

/// The root in one plane as identified.
struct PlaneFit {
  Root root;
  /// Of (c0, c1, c2); on the border of the elastic roots it is the one without that
  /// condition, which is on the safe side (see identify).
  std::array<std::array<double, 3>, 3> covariance{};
  struct Offset {
    std::string setup;
    double mm = 0, u_mm = 0;
  };
  std::vector<Offset> offsets;      ///< in order of first appearance; none of a setup
                                    ///< with outliers only
  std::vector<double> residual_mm;  ///< of all tests, outliers included
  std::vector<std::size_t> outliers;
  double s_mm = 0;  ///< standard deviation of one measurement, outliers left out
  long degrees_of_freedom = 0;
  bool on_border = false;  ///< the best elastic root has c1^2 = c0 c2
  Root unconstrained;      ///< best of all symmetric S, elastic or not
  /// How much the elastic root's sum of squares exceeds the best, over s^2: above 9, the
  /// measurements contradict every elastic chuck (drift, wrong forces, a wrong part).
  double contradiction = 0;
};

/// Robust least squares for y = x . (c0, c1, c2) + offset of the setup, Eq. (2).
///
/// Start: least trimmed squares, which bears a third of the cuts beyond the unknowns
/// being wrong.  Scale: median |residual| times 1.4826 (1 + 5/(n - unknowns)).  Then
/// Tukey's loss (4.685 scales) by reweighting, then ordinary least squares over the cuts
/// within kOutlier standard deviations, left out and taken back until they stay: a cut is
/// either used in full or named as an outlier.  Where what is left cannot tell the
/// compliance, all cuts are used.
///
/// S = L L^T with L lower triangular has no indefinite values.  The loss is convex in S
/// and the elastic S are a convex cone, so: if the best S of all is elastic, that is it;
/// else the best lies on the border, L = (a, b)^T (1 column), and is found over the
/// angle of (a, b) in full, the length being a linear problem.  (Steps in L itself stall
/// at L = 0.)  The projection onto a convex cone in the metric of the least squares
/// brings no two points further apart, so the border's errors are at most those of the
/// unconstrained covariance s^2 (X^T X)^-1.
/// @throws std::domain_error if the rank is not 3, no degree of freedom is left, or a
/// value is not finite.
PlaneFit identify(std::span<const PlaneTest> tests, Plane plane);

inline constexpr double kOutlier = 4;  ///< standard deviations; larger keeps more cuts

/// A value with its standard error.
struct Estimate {
  double value = 0, u = 0;
};

/// Deflection of the root at z under F and C: x . c and (x^T cov x)^(1/2) [mm].
Estimate predicted_deflection(const PlaneFit& fit, double z_mm, double F_N, double C_Nmm);

/// Radius error of the root, delta_r + delta_t^2/D; without a tangential fit the second
/// term is 0.  The planes' errors are independent.
Estimate predicted_radius_error(const PlaneFit& radial, const PlaneFit* tangential,
                                double z_mm, double D_mm, const Load& load);

/// The three springs of [Valino 2008], c0 = 1/k1 + Lc^2/k2, c1 = Lc/k2,
/// c2 = 1/k2 + 1/k3, as flexibilities, so that a rigid spring is 0.
struct Springs {
  double Lc_mm = 0;
  double per_k1_mm_N = 0, per_k2_rad_Nmm = 0, per_k3_rad_Nmm = 0;
};

/// The arms Lc for which no spring is negative, [c1/c2, c0/c1]; nothing if c1 <= 0 or S
/// is not elastic.  S has three numbers, the springs and Lc four: every Lc between is as
/// good.
struct ArmRange {
  double least_mm = 0, largest_mm = 0;
};
std::optional<ArmRange> arms(const Root& root);

/// The springs for an arm; nothing outside arms() (but for rounding, 1e-9).
std::optional<Springs> springs(const Root& root, double Lc_mm);

/// Standard errors of the three flexibilities for an arm that is given: they are linear
/// in (c0, c1, c2), so that of 1/k1 = c0 - Lc c1 is (v0 - 2 Lc v01 + Lc^2 v1)^(1/2), and
/// so on, v being the fit's covariance.
Springs spring_errors(const PlaneFit& fit, double Lc_mm);

}  // namespace turnwright::deflection
