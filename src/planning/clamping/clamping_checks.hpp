#pragma once
#include <string>

#include "made_surfaces.hpp"

namespace turnwright::planning {

/// Whether a setup's steady rest stands between jaws and free end.
bool rest_stands_free(const PreparedPart& plan, std::size_t setup);

/// The reason why a clamping cannot be used in a setup that cuts `work` on a part of
/// which `done` is finished: the chuck's range, the distance between centres, a surface
/// in the way of a centre or rest, buckling under the tailstock's thrust.  Empty if it
/// can be used.
std::string unusable(const PreparedPart& plan, std::size_t setup, Clamping clamping,
                     const SetupWork& work, const Finished& done);

}  // namespace turnwright::planning
