#pragma once
#include "site.hpp"

namespace turnwright::nc {

/// Refuses an operation whose insert or holder would meet the live centre on its way, which
/// begins at a position.  Along a move the least radius is taken in steps of half a
/// millimetre, on the safe side.
void keep_clear_of_centre(Site& site, const planning::OperationPlan& operation,
                          Point from);

}  // namespace turnwright::nc
