#pragma once
#include <string>

#include "message.hpp"

namespace turnwright::service {

/// One line for one answered call.  Status 499: the client left first.
void log_call(const Call& call, int status, std::size_t bytes, double seconds);

/// Logs a fault of this program with the call in which it occurred.
void log_fault(const Call& call, const std::string& what);

}  // namespace turnwright::service
