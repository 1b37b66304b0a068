#include <cmath>
#include <stdexcept>

#include "turnwright/service/digest.hpp"
#include "turnwright/service/requests.hpp"

namespace turnwright::service {
namespace {

// JSON has no NaN: it would be written as null and be read as "absent".
void require_finite(const nlohmann::ordered_json& value, const std::string& where) {
  if (value.is_number_float() && !std::isfinite(value.get<double>()))
    throw std::domain_error(where + ": the result is not a finite number");
  if (value.is_structured())
    for (const auto& [key, member] : value.items())
      require_finite(member, where + '/' + key);
}

}  // namespace

std::string_view version() { return TURNWRIGHT_VERSION; }

nlohmann::ordered_json answer(const Request& row, const nlohmann::json& request,
                              const Context& context) {
  nlohmann::ordered_json result = row.result(request, context);
  require_finite(result, row.name);
  result.emplace("format", "turnwright-" + row.name + "-result/1");
  result["turnwright_version"] = version();
  result["request_digest"] = sha256_hex(request.dump());
  return result;
}

bool infeasible(const nlohmann::ordered_json& result) {
  const auto status = result.find("status");
  return status != result.end() && *status == "infeasible";
}

}  // namespace turnwright::service
