#pragma once
#include <nlohmann/json.hpp>

#include "turnwright/base/errors.hpp"

namespace turnwright::service {

/// Problems as JSON, as HTTP, batches and the C library tell them.
nlohmann::ordered_json problem_list(const std::vector<Problem>& problems);

}  // namespace turnwright::service
