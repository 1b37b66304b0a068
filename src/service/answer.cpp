#include <algorithm>
#include <stdexcept>

#include "digest.hpp"
#include "document/json/finite.hpp"
#include "requests.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::service {

std::string_view version() { return TURNWRIGHT_VERSION; }

const Request* find_request(std::string_view name) {
  const auto rows = requests();
  const auto found = std::ranges::find(rows, name, &Request::name);
  return found == rows.end() ? nullptr : &*found;
}

// These take the same document; plan and predict also give the same.
std::string request_schema(const Request& row) {
  const bool part = row.name == "plan" || row.name == "predict" || row.name == "drawing";
  return part ? "part.json" : row.name + ".request.json";
}

std::string result_schema(const Request& row) {
  return row.name == "predict" ? "plan.result.json" : row.name + ".result.json";
}

namespace {

void sign(nlohmann::ordered_json& result, const Request& row,
          const nlohmann::json& request) {
  document::require_finite(result, row.name);
  result.emplace("format", "turnwright-" + row.name + "-result/1");
  result["turnwright_version"] = version();
  result["request_digest"] = sha256_hex(request.dump());
}

bool has_status(const nlohmann::ordered_json& result, const char* wanted) {
  const auto status = result.find("status");
  return status != result.end() && *status == wanted;
}

}  // namespace

nlohmann::ordered_json answer(const Request& row, const nlohmann::json& request,
                              const Context& context) {
  const Listening listening(context.stop);
  nlohmann::ordered_json result = row.result(request, context);
  sign(result, row, request);
  return result;
}

Drawn drawn_answer(const Request& row, const nlohmann::json& request,
                   const Context& context) {
  if (!row.drawn)
    throw std::domain_error("drawn_answer: " + row.name + " has no pictures");
  const Listening listening(context.stop);
  Drawn all = row.drawn(request, context);
  sign(all.result, row, request);
  return all;
}

std::string html_report(const Request& row, const nlohmann::json& request,
                        const Drawn& drawn) {
  if (!row.html) throw std::domain_error("html_report: " + row.name + " has no report");
  return row.html(request.value("name", tr("part")), drawn);
}

bool infeasible(const nlohmann::ordered_json& result) {
  return has_status(result, "infeasible");
}

bool not_programmed(const nlohmann::ordered_json& result) {
  return has_status(result, "not-programmed");
}

}  // namespace turnwright::service
