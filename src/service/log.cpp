#include "log.hpp"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include "turnwright/base/errors.hpp"

namespace turnwright::service {
namespace {

using nlohmann::ordered_json;

/// Members of a JSON object without its braces; they follow time and level.  What JSON
/// lets stand and a terminal may obey is escaped, too.
std::string members(const ordered_json& object) {
  const auto text =
      visible(object.dump(-1, ' ', false, ordered_json::error_handler_t::replace));
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

void log_info(const ordered_json& object) { spdlog::info(members(object)); }
void log_error(const ordered_json& object) { spdlog::error(members(object)); }

void log_event(const std::string& event, const std::string& detail) {
  log_info({{"event", event}, {"detail", detail}});
}

}  // namespace turnwright::service
