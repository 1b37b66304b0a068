#pragma once
#include <vector>

#include "auxiliary_work.hpp"
#include "planning/values/economy.hpp"
#include "turnwright/planning/process_plan.hpp"

/// The operations of a setup other than turning and boring: centre holes, drilling, arcs,
/// grooves, threads, knurls and parting off at conditions from the windows of their tools
/// (chosen_conditions.hpp), and milled places at conditions of their own
/// (milled_operations.hpp).  They do not depend on the conditions of the other surfaces.
namespace turnwright::planning {

/// These operations of a setup in their order; milled places come before parting off.
///
///     spindle:  n = min(1000 vc/(pi D), n_cap),  threads also n <= rapid/P           (1)
///     drill:  t = (depth + D/2/tan(sigma/2) + 0.5 mm a peck)/(f n),  f = k D,
///             pecks as (6) of cutting/fixed.hpp;  centre:  depth of its tip/(f n)    (2)
///     groove, part:  plunges = ceil(width/blade), each pi (r0^2 - r1^2)/(1000 vc f),
///                    with the spindle's limit as spindle.hpp (3)                     (3)
///     thread:  infeeds = max(4, ceil(passes_per_mm P)), each l/(P n), where the part
///              rises behind (l - P)/(P n)                                            (4)
///     arc:  passes = ceil(depth/ap) along the tip's path at the blank's largest
///           diameter                                                                 (5)
///     ream, tap:  t = 2 l/(f n), in and out; a tap's f is P                          (7)
///     countersink:  t = (D - d)/2/tan(sigma/2)/(f n) from the drilled hole's d on    (8)
///     counterbore: t = l/(f n)                                                      (10)
///     knurl: t = (depth + way of the wheel along the element)/(f n)                 (11)
///     minutes = sum t + feed in the air + rapids + change t/T,  edges = edge t/T     (6)
///
/// A setup on a centre drills a centre hole into the end it frees, unless that is hollow,
/// with the largest countersink of form A below 0.35 of the end's diameter, or as it is
/// drawn; a drawn one is drilled without a centre too, in the first setup that finds its end
/// faced.  Bores of a bar are drilled with the largest drill that leaves 0.5 mm on the radius
/// of the narrowest, that the drives move and that the jaws hold at the catalogue's
/// conditions, or if there is none at the gentlest of its window; boring takes the rest.
/// A hole or a thread that is reamed or tapped is drilled for that, deeper by the lead of
/// the tool.
/// Grooves take the widest blade that fits and that machine, jaws and tool bear, parting off
/// the narrowest.  Forces:
/// cutting/fixed.hpp; they are held against feed drive, power, torque, the jaws' grip and
/// the tool.  Those of knurling are not known, and written as 0.
AuxiliaryWork auxiliary_work(const PreparedPart& plan, std::size_t setup,
                             Clamping clamping, const SetupWork& work,
                             const Economy& economy);

/// The conflicts of such operations, limits that are not kept among them.
std::vector<Conflict> conflicts_of(const AuxiliaryWork& work, std::size_t setup);
/// The conflicts of a setup at fixed conditions.
std::vector<Conflict> auxiliary_conflicts(const PreparedPart& plan, std::size_t setup,
                                          Clamping clamping, const SetupWork& work);

}  // namespace turnwright::planning
