#pragma once
#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "turnwright/base/dual.hpp"

/// Spatial branch and bound over boxes of at most three log variables and any number of
/// discrete pieces: the certificate for problems that are not convex.
namespace turnwright::optimise {

inline constexpr int kBoxVariables = 3;

/// An unused variable has lower == upper.
using Box = std::array<Interval, kBoxVariables>;
using Point = std::array<double, kBoxVariables>;
using Bound = Dual<Interval, kBoxVariables>;

/// A combination that every feasible point better than the incumbent keeps below zero:
/// weight (f - cut) + sum multipliers_i g_i <= 0.  weight 1 with an optimum's multipliers
/// is its Lagrangian; weight 0 with those of a least violation refutes a box.
struct Combination {
  double weight = 0;
  std::vector<double> multipliers;
};

/// One discrete choice (pass count, tool, segment of a power curve, ...).
struct Piece {
  Box box;
  std::size_t constraints = 0;
  /// Encloses ln of the objective and every g_i, with gradients, over a box.  One more g
  /// than `constraints` is a function nowhere above f that combinations use in its place:
  /// where f has a kink, a smooth one ends the search sooner.
  std::function<void(const Box&, Bound& f, std::vector<Bound>& g)> bound;
  /// The same at a point.
  std::function<void(const Point&, double& f, std::vector<double>& g)> value;
  /// Value of the objective at a feasible point near the middle of a box, or +infinity.
  /// May note the point for the caller.
  std::function<double(const Box&)> try_point;
  std::vector<Combination> combinations;
};

struct SearchOptions {
  double gap = 2e-5;        ///< in ln(objective): smaller = more nodes
  long max_nodes = 200000;  ///< past it the answer is what was proved until then
};

struct SearchResult {
  double lower_bound =
      0;  ///< of ln(objective) over all pieces; +infinity: no feasible point
  double upper_bound = 0;  ///< best feasible value known; +infinity: none found
  long nodes = 0;
  bool complete = false;             ///< every box settled
  std::vector<double> piece_bounds;  ///< what was proved per piece, capped at the cut
};

/// Proves a lower bound of the best feasible value over all pieces.
///
/// `incumbent` is a feasible value known beforehand (+infinity: none).  A box is settled
/// when the natural or the mean value extension of a constraint or combination shows that
/// it holds no feasible point below the cut, upper_bound - gap; otherwise it is narrowed
/// by the mean value form, solved for each variable,
///
///     h(y) in h(c) + sum_j H_j (y_j - c_j),   H = gradient over the box (1)
///
/// with c, of each function, at the lower end of the variables along which it rises, at
/// the upper end of those along which it falls and in the middle of the others: a
/// function monotone over the box is bounded without error,
/// and halved across the variable that moves the functions most.  Boxes are taken lowest
/// bound first; ties in the order of birth, so the result is the same on every run.
/// Near an optimum the Lagrangian's gradient vanishes and (1) errs by the square of the
/// box, which is what ends the search.  Rounding: 1e-11 is left at every comparison.
/// Source: [Neumaier 1990], mean value form; Lagrangian cut derived here.
SearchResult branch_and_bound(std::vector<Piece>& pieces, double incumbent,
                              const SearchOptions& options = {});

}  // namespace turnwright::optimise
