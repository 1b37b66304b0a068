#pragma once
#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "turnwright/base/dual.hpp"

/// Spatial branch and bound over boxes of at most three logarithmic variables and any
/// number of discrete choices.  It gives the certificate for problems that are not
/// convex.
namespace turnwright::optimise {

inline constexpr int kBoxVariables = 3;

/// More than what Interval loses by not rounding outwards (1e-14), and than the 1e-10 to
/// which an optimum keeps its limits: it is not proved to be infeasible.
inline constexpr double kBoxRounding = 2e-10;

/// An unused variable has lower == upper.
using Box = std::array<Interval, kBoxVariables>;
using Point = std::array<double, kBoxVariables>;
using Bound = Dual<Interval, kBoxVariables>;

/// Whether a function is nowhere in the box at most `limit`.
inline bool excludes(const Bound& function, double limit) {
  return function.v.lo > limit + kBoxRounding;
}

/// A weighted sum that is at most zero at every feasible point better than the incumbent:
/// weight (f - cut) + sum multipliers_i g_i <= 0.  Weight 1 with the multipliers of an
/// optimum is its Lagrangian; weight 0 with those of a least violation refutes a box.
struct Combination {
  double weight = 0;
  std::vector<double> multipliers;
};

/// One discrete choice (pass count, tool, segment of a power curve, ...).
struct Piece {
  Box box;
  std::size_t constraints = 0;
  /// Encloses ln of the objective and every g_i, with gradients, over a box.  A g beyond
  /// `constraints` is a function nowhere above f that combinations use in place of f:
  /// where f has a kink, a smooth function ends the search sooner.
  /// Once f or one of the constraints shows that nothing in the box is feasible and below
  /// `cut` (`excludes`), false may be returned, with the other functions left out.
  std::function<bool(const Box&, double cut, Bound& f, std::vector<Bound>& g)> bound;
  /// The same at a point.
  std::function<void(const Point&, double& f, std::vector<double>& g)> value;
  /// Value of the objective at a feasible point near the middle of a box, or +infinity.
  /// The function may store the point for the caller.
  std::function<double(const Box&)> try_point;
  std::vector<Combination> combinations;
};

struct SearchOptions {
  double gap = 2e-5;        ///< in ln(objective): smaller = more nodes
  long max_nodes = 200000;  ///< after which the search ends with the bound proved so far
};

struct SearchResult {
  double lower_bound =
      0;  ///< of ln(objective) over all pieces; +infinity: no feasible point
  double upper_bound = 0;  ///< best feasible value known; +infinity: none found
  long nodes = 0;
  bool complete = false;             ///< whether every box was settled
  std::vector<double> piece_bounds;  ///< lower bound per piece, capped at the cut
};

/// Proves a lower bound of the best feasible value over all pieces.
///
/// `incumbent` is a feasible value known beforehand (+infinity: none).  A box is settled
/// when the natural or the mean value extension of a constraint or combination shows that
/// it contains no feasible point below the cut, upper_bound - gap.  Otherwise it is
/// narrowed by the mean value form, solved for each variable,
///
///     h(y) in h(c) + sum_j H_j (y_j - c_j),   H = gradient over the box (1)
///
/// and halved across the variable that changes the functions most.  For each function c
/// is at the lower end of the variables along which it rises, at the upper end of those
/// along which it falls, and in the middle of the others, so that a function monotone
/// over the box is bounded without error.  Boxes are processed lowest bound first, ties
/// in the order of their creation, so the result is the same on every run.
/// Near an optimum the gradient of the Lagrangian vanishes and the error of (1) is of
/// second order in the width of the box; this ends the search.  Every comparison allows
/// kBoxRounding.
/// Source: [Neumaier 1990], mean value form; Lagrangian cut derived here.
SearchResult branch_and_bound(std::vector<Piece>& pieces, double incumbent,
                              const SearchOptions& options = {});

}  // namespace turnwright::optimise
