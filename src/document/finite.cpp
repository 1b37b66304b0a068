#include "turnwright/document/finite.hpp"

#include <cmath>

#include "turnwright/base/errors.hpp"
#include "turnwright/document/parse.hpp"

namespace turnwright::document {

void require_finite(const nlohmann::ordered_json& value, const std::string& where) {
  if (value.is_number_float() && !std::isfinite(value.get<double>()))
    throw ModelRangeError(where + ": the result is beyond what a number holds");
  if (!value.is_structured()) return;
  for (const auto& [key, member] : value.items())
    require_finite(member, child_pointer(where, key));
}

}  // namespace turnwright::document
