#pragma once
#include "fixed_operation.hpp"

/// Centre holes, and the holes that tools on the axis make: drilled, countersunk, reamed,
/// tapped.  Equations: catalogue_operations.hpp.
namespace turnwright::planning::fixed {

/// Whether a setup drills a centre hole without being told to.
bool needs_centre(const PreparedPart& part, std::size_t setup, Clamping clamping);
/// Drills a centre hole into a face of a diameter.
void add_centre(Site& site, const char* face, double end_mm);
/// Drills the bores of an end of a bar.
void add_drilling(Site& site, part::End end);
/// What is done to a hole once it is drilled.
void add_hole_work(Site& site, const CutElement& hole);

}  // namespace turnwright::planning::fixed
