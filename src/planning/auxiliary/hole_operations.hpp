#pragma once
#include "fixed_operation.hpp"

/// Centre holes, and the holes that tools on the axis make: drilled, counterbored,
/// countersunk, reamed, tapped.  Equations: catalogue_operations.hpp.
namespace turnwright::planning::fixed {

/// Whether a setup drills a centre hole without being told to.
bool needs_centre(const PreparedPart& part, std::size_t setup, Clamping clamping);
/// Drills a centre hole into a face of a diameter.
void add_centre(Site& site, const char* face, double end_mm);
/// Drills the bores of an end of a bar.
void add_drilling(Site& site, part::End end);
/// Opens a counterbore before anything is bored.
void add_counterbore(Site& site, std::size_t inner);
/// The chamfer where a hole that is made leaves the part.
void add_closing_chamfer(Site& site, std::size_t inner);
/// What is done to a hole once it is drilled.
void add_hole_work(Site& site, const CutElement& hole);

}  // namespace turnwright::planning::fixed

namespace turnwright::planning {

/// Where [mm, in the program's z] the material of a hole that is drawn from `begins_mm`
/// inwards begins for a reamer or a tap: there, or at the face that stands before it.
double hole_start_mm(double begins_mm, double front_mm);

/// How far [mm] before it a reamer or a tap is fed from: of a tap three pitches, in which
/// spindle and feed fall into step.
double before_hole_mm(const part::Cut& hole);

/// Where [mm, in the program's z] a flat drill cuts the inner element of an index: from the
/// material of the end, or from the floor of a counterbore before it, to its floor.
struct CounterboreWay {
  double from_mm = 0, to_mm = 0;
};
CounterboreWay counterbore_way(const part::Drawing& drawing, std::size_t inner,
                               double front_mm);

/// How deep [mm] a drill goes in a setup whose free end is `end`, its point left out: as far
/// as the bores of that end.  Where these meet what later setups open, a bore of the other
/// end or the other face, boring overruns them into material that still stands: the drill
/// goes before it by the two largest corners and 0.2 mm, as far as it reaches.
double drilled_depth_mm(const PreparedPart& part, std::size_t setup, part::End end,
                        double longest_mm);

/// Diameter [mm] drilled from an end of a bar before its bores are bored: the largest of
/// the plan's drills that leaves 0.5 mm on the radius of the narrowest bore, reaches
/// their end, whose point cuts neither a narrower bore nor a wall behind, and for which
/// power and torque of the spindle and the grip of the jaws suffice; 0 if nothing is
/// drilled.  Needs `work`, `grips_mm` and `jaws` of the part.
double drilled_mm(const PreparedPart& part, part::End end);

/// Diameter [mm] to which an inner element is open before it is bored: drilled, or by the
/// flat drills of counterbores behind it.
double before_boring_mm(const part::Drawing& drawing, std::size_t inner,
                        double drilled_mm);

}  // namespace turnwright::planning
