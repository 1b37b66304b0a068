#pragma once
#include <optional>
#include <string>
#include <vector>

#include "planning/clamping/made_surfaces.hpp"

/// Who cuts the chamfers of the drawing.  A chamfer has no operation of its own: a tool cuts
/// it on its way, in a setup in which it faces the free end.
namespace turnwright::planning {

/// The chamfer of an element at its end towards the free end of a setup.
std::optional<part::Chamfer> front_chamfer(const PreparedPart& plan, std::size_t setup,
                                           const Element& element);

/// Largest radius [mm] that may stay in the inner corner behind an element, as its setup's
/// tool goes; nothing if any may.
std::optional<double> fillet_behind_mm(const PreparedPart& plan, std::size_t setup,
                                       const Element& element);

/// Whether a setup makes an element.
bool makes(const SetupWork& work, const Element& element);

/// How far [mm] a chamfer that is cut into stock goes on beyond the surface that is made
/// later, before the tool is drawn out: the fillet that a corner of radius r leaves there,
/// r tan((pi/2 - angle)/2), and a twentieth of a millimetre stay above that surface.
double beyond_surface_mm(const part::Chamfer& chamfer, double corner_mm);

/// A sentence for each chamfer that no setup cuts.  Setups that can:
///  - the one that makes the element: every pass begins along the chamfer;
///  - one that makes the lower element in front, and so the wall between them: the last
///    pass, or the facing tool, goes along the chamfer; into stock, if the element is made
///    later, which no finishing tool's largest depth may forbid;
///  - one that faces the end after the element has been made.
std::vector<std::string> chamfers_not_cut(const PreparedPart& plan,
                                          const std::vector<SetupWork>& setups);

}  // namespace turnwright::planning
