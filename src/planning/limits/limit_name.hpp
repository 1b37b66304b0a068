#pragma once
#include <string>

#include "limit_table.hpp"

namespace turnwright::planning {

/// The name of a number that sets a limit, as prices and changed requests show it:
/// "roughness Ra of d1".
std::string limit_name(const PlanRequest& request, const LimitRow& row,
                       const LimitNumber& number, std::size_t owner);

}  // namespace turnwright::planning
