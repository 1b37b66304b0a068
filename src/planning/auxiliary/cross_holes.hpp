#pragma once
#include "auxiliary_work.hpp"
#include "planning/values/economy.hpp"

/// Cross holes, drilled into the side of the part by a driven drill.
namespace turnwright::planning {

/// Depth [mm] of a drill's tip below the rim of the cylinder:
///
///     deep + (D/2)/tan(sigma/2)                                                     (1)
///
/// with the depth of its corners as drawn, or of a hole that goes through 0.2 mm beyond where
/// the last of them leaves the material (Milled::depth_mm).
double cross_hole_tip_mm(const Milled& hole, const catalogue::FixedTool& drill);

/// Drills a cross hole with the drill of its diameter, at the speed and feed of its window
/// that cost least; the driven spindle's speeds, power and torque, its largest feed speed and
/// the feed drive's thrust limit them.
///
///     t = (tip + 0.5 mm a peck)/(f n)                                               (2)
///
/// Forces and pecks are those of cutting/fixed.hpp.  The thrust points at the part's axis, so
/// that it neither turns the part in the jaws nor draws it out.  A drill serves if it reaches
/// the depth, its holder, of a radius of 25 mm, clears what stands beside the hole, and its
/// point leaves what lies behind a hole that does not go through.
void add_cross_hole(const PreparedPart& part, const MilledPlace& hole, std::size_t setup,
                    Clamping clamping, const Economy& economy, AuxiliaryWork& out);

}  // namespace turnwright::planning
