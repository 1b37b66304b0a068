#pragma once
#include <optional>
#include <vector>

#include "document/json/reader.hpp"
#include "turnwright/deflection/ovality.hpp"
#include "turnwright/part/shaft.hpp"

namespace turnwright::document {

/// A shaft of cylinders with keyways and flats milled into some of them.
using MilledShaft = std::vector<deflection::Stretch>;

/// Reads "shaft" with `slots` in its segments: {"width_mm", "floor_mm", "angle_deg"},
/// without a width for flats.  They must lie within the rim and meet neither the bore nor
/// each other.
/// @return the shaft, and its sections if any segment has slots.
struct ReadShaft {
  part::Shaft shaft;
  std::optional<MilledShaft> milled;
};
ReadShaft read_milled_shaft(Reader r);

/// Whether two slots meet, at the rim or, if they are wide and deep, further inside.
bool meet(const deflection::Slot& a, const deflection::Slot& b, double outer_mm);

}  // namespace turnwright::document
