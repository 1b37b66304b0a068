#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace turnwright::service {

/// Whether the value of an Authorization header carries one of the keys.  Takes the same
/// time whatever the header says.
bool authorized(const std::vector<std::string>& keys, std::string_view authorization);

}  // namespace turnwright::service
