#pragma once
#include "turnwright/catalogue/machine.hpp"
#include "turnwright/deflection/beam.hpp"
#include "turnwright/planning/plan_request.hpp"

/// Supports of a clamping on a lathe, and the time they take.
namespace turnwright::planning {

/// Supports of the radial and the tangential plane of a clamping on a lathe.  A steady
/// rest has its place from the plan, its compliance from the machine.
struct Planes {
  deflection::Supports radial, tangential;
};
Planes planes(const catalogue::Lathe& machine, Clamping clamping);

/// Minutes to bring in centres and rests of a clamping.
double clamping_min(const catalogue::Lathe& machine, Clamping clamping);

/// Whether a tailstock presses on the part.
bool has_tailstock(Clamping clamping);

}  // namespace turnwright::planning
