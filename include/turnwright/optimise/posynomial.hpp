#pragma once
#include <Eigen/Core>
#include <limits>

/// Sums of products of powers under limits that are products of powers: in logarithms a
/// convex problem with linear limits, small, dense and solved many times over.
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
  /// Stop as soon as nothing below it is possible.
  double cutoff = std::numeric_limits<double>::infinity();
};

struct PosynomialOptimum {
  Eigen::VectorXd y;
  double f = 0;
  double violation = 0;         ///< largest limit at y, or 0
  Eigen::VectorXd multipliers;  ///< of the limits, >= 0
  /// Of f over all allowed y: convex_lower_bound with y and the multipliers, true
  /// whether or not the solver came to its end.
  double lower_bound = -std::numeric_limits<double>::infinity();
};

/// The optimum by a primal-dual interior point method with Mehrotra's corrector.
///
/// Every limit may be passed by one common t >= 0 at the price w t, so that there is
/// always an inside to walk in, also where two limits leave a single value (a tool life
/// that is prescribed) or nothing at all:
///
///     min f(y) + w t,  limits_i(y) <= t                                           (1)
///
/// While t does not vanish the price is raised from 1e3 to 1e7; t left above 1e-9 then
/// says that no y is allowed, as does a lower bound above any value f can have in the
/// box. Cost: 20 to 40 factorisations of the size of y; no solver of the house gives
/// multipliers, of which the bound is made.
/// Source: [Boyd 2004], geometric programs, primal-dual methods and, as one problem in
/// (1), their search for a first allowed point; [Mehrotra 1992].
/// @throws std::domain_error if sizes disagree or a bound is not finite and ordered.
PosynomialOptimum minimise(const Posynomial& problem,
                           const PosynomialOptions& options = {});

}  // namespace turnwright::optimise
