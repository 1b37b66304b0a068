#pragma once
#include <optional>
#include <string>
#include <vector>

#include "planning/clamping/made_surfaces.hpp"

/// Who cuts the edges of the drawing.  A chamfer is cut in a setup in which it faces the
/// free end, by a tool on its way where that is possible.
namespace turnwright::planning {

/// The chamfer of an element at its end towards the free end of a setup.
std::optional<part::Chamfer> front_chamfer(const PreparedPart& plan, std::size_t setup,
                                           const Element& element);

/// Largest radius [mm] that may stay in the inner corner behind an element, as its setup's
/// tool goes; nothing if any may.
std::optional<double> fillet_behind_mm(const PreparedPart& plan, std::size_t setup,
                                       const Element& element);

/// The undercut behind an outer element, as its setup's tool goes.
std::optional<part::Undercut> undercut_behind(const PreparedPart& plan, std::size_t setup,
                                              const Element& element);

/// Whether a setup makes an element.
bool makes(const SetupWork& work, const Element& element);

/// How far [mm] a chamfer that is cut into stock goes on beyond the surface that is made
/// later, before the tool is drawn out: the fillet that a corner of radius r leaves there,
/// r tan((pi/2 - angle)/2), and a twentieth of a millimetre stay above that surface.
double beyond_surface_mm(const part::Chamfer& chamfer, double corner_mm);

/// Whether a tool takes the ring of stock above such a chamfer, and what roughing leaves on
/// the wall, in one cut.
bool takes_ring(const catalogue::Tool& tool, const part::Chamfer& chamfer);

/// Gives the chamfers that no tool cuts on its way to a setup with a pass of their own;
/// returns a sentence for each that no setup can cut.  A tool cuts a chamfer on its way in
///  - the setup that makes the element: every pass begins along the chamfer;
///  - one that makes the lower element in front, and so the wall between them: the last
///    pass, or the facing tool, goes along the chamfer; into stock, if the element is made
///    later.
/// At an end of the part that is faced and free after the element has been made a pass of
/// its own does it.
std::vector<std::string> assign_chamfers(const PreparedPart& plan,
                                         std::vector<SetupWork>& setups);

/// A sentence for each undercut that no setup cuts: the one that makes its element comes
/// from the shoulder's side, or faces that shoulder by itself.
std::vector<std::string> undercuts_not_cut(const PreparedPart& plan,
                                           const std::vector<SetupWork>& setups);

}  // namespace turnwright::planning
