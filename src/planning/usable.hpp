#pragma once
#include <string>

#include "turnwright/planning/setup_geometry.hpp"

namespace turnwright::planning {

/// Whether a setup's steady rest stands between jaws and free end.
bool rest_stands_free(const PreparedPart& plan, std::size_t setup);

/// Why a clamping cannot be used at all in a setup that does `work` on a part with `done`
/// finished: what the chuck holds, the room between centres, what stands in the way of a
/// centre or rest, buckling under the tailstock.  Nothing: it can.
std::string unusable(const PreparedPart& plan, std::size_t setup, Clamping clamping,
                     const SetupWork& work, const Finished& done);

}  // namespace turnwright::planning
