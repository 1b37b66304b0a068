#include "log.hpp"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <nlohmann/json.hpp>

namespace turnwright::service {
namespace {

using nlohmann::ordered_json;

/// Members of a JSON object without its braces; they follow time and level.
std::string members(const ordered_json& object) {
  const auto text = object.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  return text.substr(1, text.size() - 2);
}

}  // namespace

void start_log() {
  auto logger = spdlog::stderr_logger_mt("turnwright");
  logger->set_pattern(R"({"time":"%Y-%m-%dT%H:%M:%S.%eZ","level":"%l",%v})",
                      spdlog::pattern_time_type::utc);
  logger->flush_on(spdlog::level::info);
  spdlog::set_default_logger(std::move(logger));
}

void log_call(const Call& call, int status, std::size_t bytes, double seconds) {
  spdlog::info(members({{"event", "call"},
                        {"id", call.request_id},
                        {"method", call.method},
                        {"target", call.target.substr(0, 200)},
                        {"status", status},
                        {"bytes", bytes},
                        {"ms", 1e3 * seconds}}));
}

void log_event(const std::string& event, const std::string& detail) {
  spdlog::info(members({{"event", event}, {"detail", detail}}));
}

void log_fault(const Call& call, const std::string& what) {
  spdlog::error(members({{"event", "fault"}, {"id", call.request_id}, {"what", what}}));
}

}  // namespace turnwright::service
