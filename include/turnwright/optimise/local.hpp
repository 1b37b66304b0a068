#pragma once
#include <functional>
#include <span>
#include <vector>

/// Local optimisation of smooth problems in logarithmic variables by NLopt, and the lower
/// bounds that follow from an optimum.  This library knows nothing of machining.
namespace turnwright::optimise {

/// ln of the objective and the constraints g_i <= 0 with their gradients at one point.
/// Jacobian row i is the gradient of g_i; sizes are set by the caller.
struct Values {
  double f = 0;
  std::vector<double> df;  ///< n
  std::vector<double> g;   ///< m
  std::vector<double> dg;  ///< m x n, row by row
};

/// min f(y) subject to g(y) <= 0 and lower <= y <= upper.
struct Problem {
  std::vector<double> lower, upper;
  std::size_t constraints = 0;
  std::function<void(std::span<const double> y, Values& out)> evaluate;
};

struct Options {
  double feasibility = 1e-10;  ///< largest g that counts as kept; smaller = more steps
  double f_tolerance = 1e-13;  ///< stop when f changes less; larger = looser certificates
  int max_evaluations = 150;   ///< of one run of the solver
  bool insist = true;  ///< try CCSAQ after SLSQP: slow where no feasible point exists
};

/// A local solver cannot prove that no feasible point exists, only that it found none.
enum class Status { converged, budget_spent, no_feasible_point_met };

struct Solution {
  Status status = Status::no_feasible_point_met;
  std::vector<double> y;
  double f = 0;
  std::vector<double> g;            ///< re-evaluated at y
  double worst = 0;                 ///< max g
  std::vector<double> multipliers;  ///< of g, >= 0, see multipliers_at
  int evaluations = 0;
};

/// Local minimum from `start` (clamped into the box) by SLSQP [Kraft 1988], followed by
/// CCSAQ [Svanberg 2002] where SLSQP finds no feasible point.  Every constraint is
/// evaluated again at the answer, because NLopt's return codes do not prove feasibility.
/// An exception of `evaluate` is passed on unchanged.
/// @throws std::domain_error if sizes disagree, bounds are not in order, or a bound or
///   start is not finite.
Solution local_minimum(const Problem& problem, std::span<const double> start,
                       const Options& options = {});

/// Least violation: min s subject to g_i(y) <= s, s >= `floor`.  f of the result is s.
/// The multipliers sum to one and identify the conflicting constraints.
Solution least_violation(const Problem& problem, std::span<const double> start,
                         double floor, const Options& options = {});

/// Multipliers lambda >= 0 of the constraints close to their limit (g > -near, or up to
/// 1000 near if y is not stationary with these alone), by non-negative least squares:
///
///     min | df + sum lambda_i dg_i + (bounds active at y) |,  lambda >= 0
///
/// Rows whose variable is at a bound may keep a residual of the sign that the bound
/// allows.
std::vector<double> multipliers_at(const Problem& problem, std::span<const double> y,
                                   const Values& at, double near = 1e-6);

/// Lower bound of f over every feasible y of the box, for convex f and g:
///
///     f(y) >= f* + sum lambda_i g_i*
///             + sum_j min(r_j (lower_j - y*_j), r_j (upper_j - y*_j))                (1)
///     r = df* + sum lambda_i dg_i*
///
/// Valid for any lambda >= 0; tight at an optimum.  Source: weak duality, [Boyd 2004];
/// (1) derived here.
double convex_lower_bound(const Problem& problem, std::span<const double> y,
                          const Values& at, std::span<const double> multipliers);

}  // namespace turnwright::optimise
