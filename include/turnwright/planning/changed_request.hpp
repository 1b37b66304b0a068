#pragma once
#include <string>

#include "turnwright/planning/prepared_part.hpp"

namespace turnwright::planning {

/// A changed request and the name of the change.
struct WhatIf {
  std::string name;
  PreparedPart part;
};

}  // namespace turnwright::planning
