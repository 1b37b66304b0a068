#pragma once
#include "turnwright/planning/prepared_part.hpp"

namespace turnwright::planning {

/// How far each boring bar sticks out that may choose (`longest_mm`):
///
///     deepest bore that it enters, as far as longest_mm reaches, and 2 mm, up to whole
///     5 mm, but its head and a diameter at least                                     (1)
///
/// A bar that reaches none of its bores sticks out as its document says.
void set_stick_outs(PreparedPart& part);

}  // namespace turnwright::planning
