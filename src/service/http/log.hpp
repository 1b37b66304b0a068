#pragma once
#include <string>

#include "message.hpp"

namespace turnwright::service {

/// Sends the log, one JSON object a line, to standard error.
void start_log();

/// One line for one answered call.  Status 499: the client left first.
void log_call(const Call& call, int status, std::size_t bytes, double seconds);

void log_event(const std::string& event, const std::string& detail);

/// A fault of this program, with the call that met it.
void log_fault(const Call& call, const std::string& what);

}  // namespace turnwright::service
