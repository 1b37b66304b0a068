#pragma once
#include "turnwright/exchange/outline.hpp"

namespace turnwright::exchange::notated {

/// The outline with the ids that a notation gives: d1, d2 .. outside from left to right, b1,
/// b2 .. inside, also wherever they are referred to.
Outline with_running_ids(Outline outline);

}  // namespace turnwright::exchange::notated
