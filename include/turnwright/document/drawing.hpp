#pragma once
#include <nlohmann/json.hpp>

#include "turnwright/document/prepared_part.hpp"

namespace turnwright::document {

/// The result of `drawing` (schemas/drawing.result.json): the part document as it is
/// read, before anything is planned: the position of every surface, every tolerance in
/// mm, the end of the jaws, the setup that cuts each surface, and the assumed values.
///
/// z [mm] counts from the left end of the finished part.  Diameters are those drawn: for
/// a thread the nominal one, for an arc those of its ends.  A surface that no setup can
/// make has no `setup`.
nlohmann::ordered_json drawing(const PreparedDocument& prepared);

}  // namespace turnwright::document
