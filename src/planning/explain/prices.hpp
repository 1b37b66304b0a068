#pragma once
#include <vector>

#include "planning/setup/solved_setup.hpp"

namespace turnwright::planning {

/// The price of every limit whose relaxation saves something, largest saving first.
std::vector<Price> prices(const PreparedPart& plan,
                          const std::vector<SolvedSetup>& setups);

}  // namespace turnwright::planning
