#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace turnwright::service {

/// Whether the value of an Authorization header contains one of the keys, in a time that
/// does not depend on the header.
bool authorized(const std::vector<std::string>& keys, std::string_view authorization);

}  // namespace turnwright::service
