#pragma once
#include "turnwright/document/reader.hpp"
#include "turnwright/part/shaft.hpp"

namespace turnwright::document {

/// {"E_MPa", "nu", "segments": [{"length_mm", "outer_left_mm", ..}]}, as `deflection` has
/// it: no inner diameters are a solid segment.
part::Shaft read_shaft(Reader r);

}  // namespace turnwright::document
