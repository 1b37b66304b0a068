#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace turnwright::deflection {

/// Largest model that may be fitted to a deviation graph.
struct GraphOptions {
  int max_degree = 3;  ///< 0 to 6: a propped bar's deflection has degree 6
  int max_steps = 3;   ///< 0 to 10; larger = slower
};

/// A jump of the carriage between two neighbouring measured positions.
struct CarriageStep {
  double after_mm = 0, before_mm = 0;  ///< the positions between which it lies
  double height_mm = 0;                ///< by which e is larger beyond it
  double u_mm = 0;                     ///< standard error for a known position
  /// Probability that noise alone makes such a step anywhere on the graph, Eq. (3), <= 1.
  double p = 0;
};

/// A smooth deviation after removal of the carriage's steps.
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

/// Fit of one polynomial over the whole graph and of steps of unknown position and
/// height,
///
///     e(z) = sum_j a_j z^j + sum_k h_k [z > s_k]                                 (1)
///
/// Steps are judged together with the polynomial of the largest degree allowed, so that a
/// curvature that a lower degree cannot follow is not taken for a step.  Steps that
/// reduce the residual sum of squares from R0 to R1 are accepted if, by the F-test, noise
/// alone would hardly do so at any of the N possible positions, or pairs of them
/// (Bonferroni),
///
///     N P(F_{q, f} > ((R0 - R1)/q)/(R1/f)) < kStepLevel,  q = 1 or 2 steps more,  (2)
///
/// f = points - degree - 1 - steps.  One more step is tried first, then two at once,
/// because two opposite steps hide each other.  For each step of the result Eq. (2)
/// becomes
///
///     p = N P(|t_f| > |h|/u).                                                    (3)
///
/// Finally the degree is chosen by the Bayesian information criterion, as that of least
/// n ln(RSS/n) + (degree + 1) ln n with those steps.  There is only one polynomial
/// because the carriage shifts the graph and does not bend it, and a deflection and its
/// slope are continuous where the section changes.  All single positions and all pairs
/// are tried; from three steps on a step is added to the best fit with one step less, and
/// each step in turn is moved to its best position until none moves, which finds only a
/// local minimum.  At least three positions lie between two steps and outside them, so
/// that one wrong point cannot make two steps.  Valid for at least max_degree + 3
/// different positions.  R^2 is 1 for a graph without any variation.
/// Source: [Schwarz 1978] for the degree; the rest derived here.
/// @throws std::domain_error if there are fewer positions, sizes differ, a value is not
///   finite or the options are out of range.
DeviationGraph deviation_graph(std::span<const double> z_mm, std::span<const double> e_mm,
                               const GraphOptions& options = {});

}  // namespace turnwright::deflection
