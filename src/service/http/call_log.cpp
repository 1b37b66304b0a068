#include "call_log.hpp"

#include "service/log.hpp"

namespace turnwright::service {

void log_call(const Call& call, int status, std::size_t bytes, double seconds) {
  log_info({{"event", "call"},
            {"id", call.request_id},
            {"method", call.method},
            {"target", call.target.substr(0, 200)},
            {"status", status},
            {"bytes", bytes},
            {"ms", 1e3 * seconds}});
}

void log_fault(const Call& call, const std::string& what) {
  log_error({{"event", "fault"}, {"id", call.request_id}, {"what", what}});
}

}  // namespace turnwright::service
