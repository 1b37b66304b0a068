#pragma once
#include "setup_view.hpp"

namespace turnwright::report {

/// Draws what holds the part: jaws bored to it, centres, a steady rest.
void draw_clamping(SetupView& view);

}  // namespace turnwright::report
