#pragma once
#include "turnwright/planning/prepared_part.hpp"

/// What the jaws of a setup close on, and with which force.
namespace turnwright::planning {

/// Diameter [mm] the jaws close on, 0 between centres.
double grip_diameter_mm(const PreparedPart& part, std::size_t setup, Clamping clamping);

/// Largest bore [mm] between the jaws once the setup is done, 0 of a solid part.
double gripped_bore_mm(const PreparedPart& plan, std::size_t setup);

/// Force of all jaws at rest [N], 0 between centres; they may be eased when the roughing
/// of a setup is done.
enum class Stage { roughing, finishing };
double jaw_force_N(const PreparedPart& plan, std::size_t setup, Clamping clamping,
                   Stage stage);

}  // namespace turnwright::planning
