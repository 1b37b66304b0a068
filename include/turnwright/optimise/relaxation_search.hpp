#pragma once
#include <functional>

#include "turnwright/optimise/branch_and_bound.hpp"

namespace turnwright::optimise {

/// Result of a relaxation over a box.
struct Relaxed {
  double lower = 0;  ///< lower bound over the box; +infinity: no feasible point in it
  double upper = 0;  ///< value of any feasible point; +infinity: none found
  std::size_t split = 0;  ///< variable whose range makes the relaxation loose
  double at = 0;          ///< value at which to split it
};

/// Branch and bound in which each box has its own relaxation, usually a convex program in
/// more variables than the box has: the box holds only the variables that make the
/// problem non-convex.  Boxes are processed lowest bound first, ties in the order of
/// creation.
///
/// `relax(box, cut)` may stop as soon as its bound is above the cut.  The result's
/// `lower_bound` is that of the whole box: at least upper_bound - gap where the search is
/// complete, and +infinity where no point is feasible.
/// Source: [Horst 1996], prototype branch and bound.
SearchResult relaxation_search(
    const Box& box, double incumbent,
    const std::function<Relaxed(const Box&, double cut)>& relax,
    const SearchOptions& options = {});

}  // namespace turnwright::optimise
