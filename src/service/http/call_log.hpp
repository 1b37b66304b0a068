#pragma once
#include <string>

#include "message.hpp"

namespace turnwright::service {

/// One line for one answered call.  Status 499: the client left first.
void log_call(const Call& call, int status, std::size_t bytes, double seconds);

/// A fault of this program, with the call that met it.
void log_fault(const Call& call, const std::string& what);

}  // namespace turnwright::service
