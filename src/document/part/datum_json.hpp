#pragma once
#include <nlohmann/json.hpp>

#include "turnwright/part/drawing.hpp"

namespace turnwright::document {

/// The datum of a tolerance as a part document has it: "d2", or ["d2", "d6"] for the common
/// datum A-B of two elements.
inline nlohmann::ordered_json datum_json(const part::Tolerance& t) {
  if (t.common_datum.empty()) return t.datum;
  return {t.datum, t.common_datum};
}

}  // namespace turnwright::document
