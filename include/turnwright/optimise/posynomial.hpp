#pragma once
#include <Eigen/Core>
#include <limits>

/// Geometric programs: sums of products of powers under limits that are products of
/// powers.  In logarithms they are convex with linear limits.  The problems are small and
/// dense, and many of them are solved.
namespace turnwright::optimise {

/// Rows c_k + a_k . y, the logarithms of products of powers of exp(y).
struct Monomials {
  Eigen::MatrixXd a;  ///< one row each
  Eigen::VectorXd c;
};

/// min f(y) = ln sum_k exp(terms_k(y)) subject to limits_i(y) <= 0, lower <= y <= upper.
struct Posynomial {
  Monomials terms, limits;
  Eigen::VectorXd lower, upper;
};

struct PosynomialOptions {
  double gap = 1e-10;  ///< in f; smaller = more steps
  /// The solver stops as soon as no value below this one is possible.
  double cutoff = std::numeric_limits<double>::infinity();
};

struct PosynomialOptimum {
  Eigen::VectorXd y;
  double f = 0;
  double violation = 0;         ///< largest limit at y, or 0
  Eigen::VectorXd multipliers;  ///< of the limits, >= 0
  /// Lower bound of f over all feasible y: convex_lower_bound with y and the multipliers.
  /// It holds whether or not the solver converged.
  double lower_bound = -std::numeric_limits<double>::infinity();
};

/// The optimum by a primal-dual interior point method with Mehrotra's corrector.
///
/// Every limit may be exceeded by one common t >= 0 at the price w t, so that the
/// feasible set always has an interior, also where two limits admit a single value (a
/// prescribed tool life) or none at all:
///
///     min f(y) + w t,  limits_i(y) <= t                                           (1)
///
/// The price is raised from 1e3 to 1e7 while t does not vanish.  If t then remains above
/// 1e-9 no y is feasible; the same follows from a lower bound above every value of f in
/// the box.  The cost is 20 to 40 factorisations of the size of y.  NLopt cannot be used
/// here because it does not return the multipliers, which the bound needs.
/// Source: [Boyd 2004], geometric programs and primal-dual methods, whose two phases (1)
/// combines; [Mehrotra 1992].
/// @throws std::domain_error if sizes disagree or a bound is not finite and ordered.
PosynomialOptimum minimise(const Posynomial& problem,
                           const PosynomialOptions& options = {});

}  // namespace turnwright::optimise
