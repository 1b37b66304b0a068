#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace turnwright::deflection {

/// What may be fitted to a deviation graph.
struct GraphOptions {
  int max_degree = 3;  ///< 0 to 6: a propped bar's deflection has degree 6
  int max_steps = 3;   ///< 0 to 10; larger = slower
};

/// A jump that the carriage made between two neighbouring measured places.
struct CarriageStep {
  double after_mm = 0, before_mm = 0;  ///< the places it lies between
  double height_mm = 0;                ///< e beyond it is larger by so much
  double u_mm = 0;                     ///< standard error, the place taken as known
  /// Chance that noise alone makes such a step anywhere on the graph, Eq. (3), at most 1.
  double p = 0;
};

/// A smooth deviation with the carriage's steps taken out.
struct DeviationGraph {
  std::vector<double> coefficients;    ///< of 1, z, z^2, ..: mm, 1, 1/mm, ..
  std::vector<double> u_coefficients;  ///< their standard errors
  std::vector<CarriageStep> steps;     ///< in rising z
  double r2 = 0;              ///< of the graph less its steps about the polynomial
  double r2_as_measured = 0;  ///< of a polynomial of that degree through the graph as is
  double s_mm = 0;            ///< standard deviation about the fit
  long degrees_of_freedom = 0;
};

inline constexpr double kStepLevel = 0.01;  ///< of Eq. (3); larger = more false steps

/// One polynomial over the whole graph and steps of free place and height,
///
///     e(z) = sum_j a_j z^j + sum_k h_k [z > s_k]                                 (1)
///
/// Steps are judged beside the polynomial of the largest degree allowed, so that what a
/// lower one cannot follow makes no steps.  Steps that take RSS from R0 to R1 are
/// accepted if the F-test says that noise alone does so at none of the N places (or
/// pairs) they might stand at (Bonferroni),
///
///     N P(F_{q, f} > ((R0 - R1)/q)/(R1/f)) < kStepLevel,  q = 1 or 2 steps more,  (2)
///
/// f = points - degree - 1 - steps.  One more is tried first, then two at once: two
/// opposite ones hide each other.  For each step of the result Eq. (2) becomes
///
///     p = N P(|t_f| > |h|/u).                                                    (3)
///
/// Last, the degree is the one of least BIC = n ln(RSS/n) + (degree + 1) ln n beside
/// those steps. The polynomial is one because the carriage moves the graph and does not
/// bend it; a deflection and its slope are continuous where the section changes. Places
/// are sought over all single ones and all pairs; from three steps on one is added to the
/// best fewer and each in turn is moved to its best place until none moves, which finds a
/// local least only.  Between two steps, and outside them, lie at least three places, so
/// that one wrong point makes no two steps. Valid for at least max_degree + 3 different
/// places.  R^2 is 1 for a graph without any variation. Source: derived here.
/// @throws std::domain_error if there are fewer places, sizes differ, a value is not
///   finite or the options are out of range.
DeviationGraph deviation_graph(std::span<const double> z_mm, std::span<const double> e_mm,
                               const GraphOptions& options = {});

}  // namespace turnwright::deflection
