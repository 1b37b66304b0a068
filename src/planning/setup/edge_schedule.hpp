#pragma once
#include <optional>
#include <vector>

#include "solved_setup.hpp"

/// When the edges of a setup are changed, and how the offsets follow their wear.
namespace turnwright::planning {

/// Whole parts until a share of an edge is used, where each uses `per_part` of it; none
/// where a part uses nothing.
std::optional<long> parts_until(double share, double per_part);

/// The schedule of every tool that a setup uses, in the order of use.  A part uses s of an
/// edge, the sum over its operations as their costs count it:
///
///     parts per edge n = floor(1/s),  edges of a batch of N parts ceil(N/n)          (1)
///
/// While the edge wears, the offset of a size moves with the wear land, which grows with
/// the parts made.  From the new edge to its change it moves by
///
///     D = k (o_change - o_new -+ r(VB))                                              (2)
///
/// o the offsets against the deflection (ToolOffset), r the recession of the edge
/// ((2) of deflection/shop_errors.hpp) at the land VB where it is changed, - outside and on
/// faces, + in a bore; k = 2 for diameters, 1 along the axis of a face.  It is corrected
/// after every m parts, u the share of an edge's life between two corrections,
///
///     m = floor(u/s), but not less than a part, nor than what moves the largest D of
///         the tool by 1 um, the increment of controls, nor than a thousandth of it   (3)
///
/// to the middle of what comes before the next, so that the error runs from one side of
/// its middle to the other, as the shares of tolerances assume:
///
///     D s (i + min(i + m, n))/2 after i = 0, m, 2 m .. < min(n, N) parts             (4)
///
/// Surfaces without a size have no steps.  Where edges do not last for one part n = 0,
/// ceil(N s) are used in a batch, and there are no steps either.
/// Source: derived here; edge_schedule_test counts part by part.
/// @param operations  of the setup, in their order
/// @param offsets     of the whole plan
std::vector<EdgeSchedule> edge_schedules(const PreparedPart& plan,
                                         const SolvedSetup& setup,
                                         const std::vector<OperationPlan>& operations,
                                         const std::vector<ToolOffset>& offsets);

}  // namespace turnwright::planning
