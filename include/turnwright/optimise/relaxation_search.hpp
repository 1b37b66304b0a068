#pragma once
#include <functional>

#include "turnwright/optimise/branch_and_bound.hpp"

namespace turnwright::optimise {

/// What a relaxation says of a box.
struct Relaxed {
  double lower = 0;  ///< nothing allowed in the box is below; +infinity: nothing allowed
  double upper = 0;  ///< value of an allowed point, wherever; +infinity: none met
  std::size_t split = 0;  ///< variable whose range makes the relaxation loose
  double at = 0;          ///< where to split it
};

/// Branch and bound where each box has a relaxation of its own, mostly a convex program
/// in more variables than the box has: the box holds only those that keep the problem
/// from being convex.  Boxes are taken lowest bound first, ties in the order of birth.
///
/// `relax(box, cut)` may stop as soon as its bound is above the cut.  The result's
/// `lower_bound` is that of the whole box: at least upper_bound - gap where the search is
/// complete, and +infinity where nothing is allowed.
/// Source: [Horst 1996], prototype branch and bound.
SearchResult relaxation_search(
    const Box& box, double incumbent,
    const std::function<Relaxed(const Box&, double cut)>& relax,
    const SearchOptions& options = {});

}  // namespace turnwright::optimise
