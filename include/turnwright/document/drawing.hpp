#pragma once
#include <nlohmann/json.hpp>

#include "turnwright/document/prepared_part.hpp"

namespace turnwright::document {

/// The result of `drawing` (schemas/drawing.result.json): the part document as it is
/// read, before anything is planned: where every surface lies, every tolerance in mm,
/// where the jaws end, which setup cuts what, and what was assumed.
///
/// z [mm] from the left end of the finished part; diameters as drawn (of a thread the
/// nominal one, of an arc its ends').  A surface that no setup can make has no `setup`.
nlohmann::ordered_json drawing(const PreparedDocument& prepared);

}  // namespace turnwright::document
