#pragma once
#include <string>
#include <vector>

#include "step_contour.hpp"
#include "turnwright/exchange/outline.hpp"

namespace turnwright::exchange {

/// What a face is, as a machinist sees it: "A cylinder of 6 mm diameter across the axis".
std::string described(const Face& face, const Axis& axis);

/// Puts the faces that are no part of the contour under `milled`, where connected ones are
/// a keyway, a slot, a cross hole or flats of an outer cylinder of the outline, and the others under
/// `ignored`.
void add_milled(const std::vector<Face>& faces, const Contour& contour, const Axis& axis,
                Outline& outline);

}  // namespace turnwright::exchange
