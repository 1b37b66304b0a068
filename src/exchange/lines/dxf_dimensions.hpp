#pragma once
#include "dxf_profile.hpp"

/// What the dimensions of a drawing ask of the elements.
namespace turnwright::exchange::dxf {

/// Gives fits, limits, threads and roughness to the elements on which definition points
/// lie, tolerances of length to pairs of faces, and the general tolerances if a text has
/// them.  What is understood in part or not at all goes to `ignored`.
/// @param z0_mm  the left end of the part along the axis of the view
void add_dimensions(Outline& out, const View& view, double z0_mm, double join_mm);

}  // namespace turnwright::exchange::dxf
