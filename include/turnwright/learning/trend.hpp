#pragma once
#include <array>
#include <optional>
#include <vector>

#include "turnwright/learning/series.hpp"

/// Drift, wear and edges in a series of parts.
///
///     y - o = mu + d t + w k + b_e + eps,  eps ~ N(0, s^2),  b_e ~ N(0, s_b^2)       (1)
///
/// Symbols: y measured value, o corrections in force [mm]; t time [h]; k parts that the
/// edge had cut before; d drift [mm/h], w wear trend [mm per part]; e the edge, b_e where
/// it stands beside the others [mm]; eps what is left, from part to part.
///
/// s comes from the scatter within edges alone: with y, t, k less their means of each edge,
///
///     s^2 = RSS_w/nu,  nu = n - E - rank_w,  nu s^2/sigma^2 ~ chi^2_nu               (2)
///
/// whatever the edges do.  s_b^2 by the fitting of constants: Q is what the regression on
/// [1, t, k] leaves over RSS_w, r its degrees of freedom, X = [1, t, k], Z the edges,
///
///     s_b^2 = (Q - r s^2)/tr K,  K = Z'(I - X (X'X)^-1 X')Z,                         (3)
///     var Q = 2 (r s^4 + 2 s^2 s_b^2 tr K + s_b^4 tr K^2)                            (4)
///
/// It is not cut off at 0, which would widen intervals where edges do not differ, but at
/// -0.6 s^2/max n_e.  Given lambda = s_b^2/s^2, generalised least squares is ordinary least
/// squares after 1 - 1/sqrt(1 + n_e lambda) of the mean of each edge has been taken off:
/// [Fuller 1974].  An interval of a coefficient has Student's t of
///
///     f = 2 v^2/(g' C g)                                                             (5)
///
/// degrees of freedom, r at least, v its variance, g the slopes of v on (s^2, s_b^2), C their
/// covariance by (2) to (4): [Satterthwaite 1946].
///
/// Where r < 4 edges compare too little, only differences within edges count (lambda
/// infinite).  Where t and k run alike within edges nothing else tells drift and wear apart:
/// then r = 2 are enough, and with fewer w has the drift in it (`drift_in_wear`).  Edges that
/// leave nu < 3 are taken as alike (`edges_ignored`).
/// Source: (1) to (5) from the origins named, written out here; trend_test compares (2), (3)
/// with balanced tables, whose analysis of variance is exact, and simulates coverage.
namespace turnwright::learning {

/// What happened to the level at a change of the edge: the first part of the new edge less
/// what one more part of the old edge would have had, by the fit within edges.
struct Jump {
  std::size_t to = 0;  ///< index of the new edge
  Estimate step_mm;
};

/// How edges stand to each other.
struct EdgeScatter {
  double variance_mm2 = 0;  ///< s_b^2 of (3), which may be negative
  double p = 1;             ///< chance of as much where edges are alike, by Fisher's F
};

/// Parts of one edge: their number and means.
struct EdgeMean {
  std::size_t edge = 0;
  double n = 0, y_mm = 0;     ///< y less the corrections in force
  std::array<double, 3> x{};  ///< 1, t, k
};

struct Trend {
  std::size_t n = 0;
  double s_mm = 0;     ///< from part to part, (2)
  double degrees = 0;  ///< of freedom of s
  /// Of the parts as they were made, on these edges and with these corrections.
  Estimate mean_mm;
  std::optional<Estimate> drift;     ///< of `at` [mm/h, or mm per part]
  std::optional<Estimate> wear;      ///< [mm per part of an edge]
  bool drift_in_wear = false;        ///< the two are one number, `wear`
  bool edges_ignored = false;        ///< too few parts of each to tell them apart
  std::optional<EdgeScatter> edges;  ///< if they are told apart
  std::vector<Jump> jumps;
  std::vector<double> standardised;  ///< residuals of (2) over their standard deviations

  // For what follows from it.
  std::vector<double> fitted_mm;  ///< of each part within edges, corrections included
  std::array<double, 3> coefficient{};                ///< of 1, t, k in (1)
  std::array<std::array<double, 3>, 3> covariance{};  ///< of coefficient
  std::array<double, 3> origin{};  ///< 1, and t, k from which coefficients count
  double coefficient_degrees = 0;  ///< the fewest of a coefficient
  bool fixed_edges = false;        ///< lambda is infinite
  std::vector<EdgeMean> means;     ///< of edges, in their order

  double lambda() const;  ///< s_b^2/s^2, not negative; 0 without `edges`
};

/// The fit of (1); none where fewer than three degrees of freedom would be left.
/// @param confidence  of the intervals.
std::optional<Trend> fit_trend(const Series& series, double confidence);

/// What one more part would measure with corrections `offset_mm` in force, on the edge of an
/// index; of an edge not yet seen the mean of all.  u is that of the expected value, without
/// the scatter from part to part:
///
///     yhat = x'beta + g (ybar_e - xbar_e'beta),  g = n_e lambda/(1 + n_e lambda)
///     u^2 = (x - g xbar_e)' cov(beta) (x - g xbar_e) + s_b^2 (1 - g)                 (6)
///
/// The best linear unbiased prediction: [Robinson 1991].
Estimate expected_mm(const Trend& trend, const Observation& next, double confidence);

}  // namespace turnwright::learning
