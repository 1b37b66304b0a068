#pragma once
#include <optional>
#include <vector>

#include "step_pocket.hpp"

namespace turnwright::exchange {

/// Connected faces as one drilled hole whose axis crosses the part's at a right angle: a
/// hollow cylinder, of one face or of several, that ends in a point, on a flat bottom, in a
/// bore or on the other side.  Nothing if a face is left over, such as a countersink.
std::optional<Pocket> cross_hole(const std::vector<const Face*>& group, const Axis& axis);

}  // namespace turnwright::exchange
