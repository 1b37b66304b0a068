#pragma once
#include <vector>

#include "turnwright/planning/prepared_part.hpp"

/// What three jaws do to a tube, and the forces they may have.
namespace turnwright::planning {

/// Share of a tolerance's width [um] that the lobes of the jaws in a tube take at a force
/// of all jaws.
double squeeze_um(const PreparedPart& part, const part::Tolerance& tolerance,
                  std::size_t setup, Clamping clamping, double force_N);

/// The jaws' forces of every setup.  Where the request gives none it is the chuck's, or
/// less, so that no hollow section is strained beyond kOfYield of the yield strength, if
/// the material's document has it.  Where the request gives none for finishing it is the
/// largest, not above roughing's, whose three-jaw lobing of a tube uses at most a quarter
/// of each affected tolerance, and at least a twentieth of roughing's.  Needs `work`
/// and `grips_mm` of the part.
std::vector<JawForces> jaw_forces(const PreparedPart& part);

}  // namespace turnwright::planning
