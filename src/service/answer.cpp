#include "turnwright/document/finite.hpp"
#include "turnwright/service/digest.hpp"
#include "turnwright/service/requests.hpp"

namespace turnwright::service {

std::string_view version() { return TURNWRIGHT_VERSION; }

nlohmann::ordered_json answer(const Request& row, const nlohmann::json& request,
                              const Context& context) {
  nlohmann::ordered_json result = row.result(request, context);
  document::require_finite(result, row.name);
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
