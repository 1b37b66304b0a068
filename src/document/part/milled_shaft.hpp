#pragma once
#include <optional>
#include <vector>

#include "document/json/reader.hpp"
#include "turnwright/deflection/ovality.hpp"
#include "turnwright/part/shaft.hpp"

namespace turnwright::document {

/// A shaft of cylinders with keyways and flats milled into some of them.
using MilledShaft = std::vector<deflection::Stretch>;

/// A shaft, and its cross-sections if any segment has slots.
struct ReadShaft {
  part::Shaft shaft;
  std::optional<MilledShaft> milled;
};
/// Reads "shaft", whose segments may have "slots": {"width_mm", "floor_mm", "angle_deg"},
/// without a width for a flat.  A slot must cut the outer surface and must not cut the
/// bore or another slot.
ReadShaft read_milled_shaft(Reader r);

/// Whether two slots meet, at the rim or, if they are wide and deep, further inside.
bool meet(const deflection::Slot& a, const deflection::Slot& b, double outer_mm);

}  // namespace turnwright::document
