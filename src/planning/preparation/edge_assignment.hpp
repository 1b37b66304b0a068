#pragma once
#include <vector>

#include "reach.hpp"
#include "turnwright/planning/prepared_part.hpp"

/// Which setup cuts which chamfers and undercuts of the drawing.
namespace turnwright::planning {

/// Finds the outer shoulders whose edges are chamfered or rounded while the element behind is
/// stock that a later setup turns, and has them faced if the request wants that: the facing
/// tool takes the ring above the chamfer from outside, at the depth of the chamfer.  One that
/// finishes the element in front comes from inside, and its major edge meets the ring in its
/// whole height.  Shoulders stay as they are where no facing tool takes the ring or has
/// enough wall.
void assign_edges_in_stock(const PreparedPart& plan, std::vector<SetupWork>& setups);

/// Gives the chamfers that no tool cuts on its way to a setup with a pass of their own;
/// returns a reason for each that no setup can cut.  A tool cuts a chamfer on its way in
///  - the setup that makes the element: every pass begins along the chamfer;
///  - one that makes the lower element in front, and so the wall between them: the last
///    pass, or the facing tool, goes along the chamfer; into stock, if the element is made
///    later.
/// At an end of the part that is faced and free after the element has been made a pass of
/// its own does it.
std::vector<Reason> assign_chamfers(const PreparedPart& plan,
                                    std::vector<SetupWork>& setups);

/// Takes the chamfers out of the drawing that the title block asks for of all edges alike and
/// that no setup cuts on its way.
void leave_to_the_hand(PreparedPart& part);

/// A reason for each undercut that no setup cuts: the one that makes its element comes
/// from the shoulder's side, or faces that shoulder by itself.
std::vector<Reason> undercuts_not_cut(const PreparedPart& plan,
                                      const std::vector<SetupWork>& setups);

}  // namespace turnwright::planning
