#include "finite.hpp"

#include <cmath>

#include "base/say.hpp"
#include "pointer.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::document {
namespace {

template <class Json>
void require(const Json& value, const std::string& where) {
  if (value.is_number_float() && !std::isfinite(value.template get<double>()))
    throw ModelRangeError(
        say("{}: the result is not a finite number, so the request is outside the "
            "model's range",
            where));
  if (!value.is_structured()) return;
  for (const auto& [key, member] : value.items())
    require(member, child_pointer(where, key));
}

}  // namespace

void require_finite(const nlohmann::json& value, const std::string& where) {
  require(value, where);
}

void require_finite(const nlohmann::ordered_json& value, const std::string& where) {
  require(value, where);
}

}  // namespace turnwright::document
