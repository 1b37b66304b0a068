#pragma once
#include <nlohmann/json.hpp>

#include "turnwright/part/drawing.hpp"

namespace turnwright::document {

/// The members by which a result names its part: "name", and of "drawing_number",
/// "revision" and "customer" those that the drawing has.
nlohmann::ordered_json title_block(const part::Drawing& drawing);

}  // namespace turnwright::document
