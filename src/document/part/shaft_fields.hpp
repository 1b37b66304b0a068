#pragma once
#include <functional>

#include "document/json/reader.hpp"
#include "turnwright/part/shaft.hpp"

namespace turnwright::document {

/// {"E_MPa", "nu", "segments": [{"length_mm", "outer_left_mm", ..}]}, as `deflection` has
/// it: no inner diameters are a solid segment.
/// `more` reads further keys of each segment.
part::Shaft read_shaft(
    Reader r, const std::function<void(Reader&, const part::Segment&)>& more = {});

}  // namespace turnwright::document
