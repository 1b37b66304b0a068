#pragma once
#include <string>
#include <vector>

#include "turnwright/review/cuts.hpp"

/// What a program that others have written does to a part: what each pass takes off the
/// stock, the forces and times that follow, and the limits that they meet or break.
///
/// The tools' whole edges are swept along the program's moves through a half section of the
/// stock.  On a line across the feed, or across its larger component, a move takes off a
/// length l, and cuts
///
///     ap = l max(|dx|, |dz|)/hypot(dx, dz)                                            (1)
///
/// deep, normal to its way.  Of all lines of a surface the depth that prevails is the
/// median over the way; the largest is told beside it, for in corners an edge meets more
/// than elsewhere.  Forces are those of planning at these depths (cutting/cut.hpp,
/// cutting/fixed.hpp), times those of programs (toolpath/setup_program.hpp).
/// Source: derived here; review_test compares programs of `nc` with their plans.
namespace turnwright::review {

/// Reviews the programs of setups in their order.  Surfaces that setups before a program
/// make, and that no program given cuts, are taken as drawn.
/// @throws std::domain_error if programs are not in the order of the part's setups.
Review review(const planning::PreparedPart& part,
              const std::vector<ReviewedProgram>& programs,
              const std::vector<MountedTool>& tools);

/// The operations of planning that a review's cuts amount to.
struct Reconstruction {
  std::vector<planning::OperationRequest> operations;
  std::vector<std::string> cannot;  ///< sentences; `operations` is then not complete
};

/// Each element's last cut finishes it, and the cuts before rough it; they must have one
/// tool, speed and feed.  Roughing passes have their mean depth, finishing ones take what
/// is left of the stock: planning reckons from nominal sizes.
Reconstruction reconstructed(const planning::PreparedPart& part, const Review& review);

/// The request for `predict` of these operations: the part's own in its first clampings,
/// with the turret's tools.
planning::PlanRequest with_operations(const planning::PreparedPart& part,
                                      std::vector<planning::OperationRequest> operations,
                                      const std::vector<MountedTool>& tools);

}  // namespace turnwright::review
