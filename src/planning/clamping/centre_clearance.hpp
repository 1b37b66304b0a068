#pragma once
#include "turnwright/planning/prepared_part.hpp"

/// Room beside the live centre that holds the free end of a setup.
namespace turnwright::planning {

/// Of the end's diameter, at most, is the countersink of a centre hole.
inline constexpr double kCentreShare = 0.35;

/// Whether a live centre stands at the free end.
bool has_live_centre(Clamping clamping);

/// Diameter [mm] of the bore at the free face, also of one that an earlier setup made through
/// to it; 0 of a solid end.
double free_bore_mm(const PreparedPart& plan, std::size_t setup);

/// The largest diameter [mm] at the free face that the point of the centre may have: of a
/// solid end the largest countersink that the plan's centre drills may give it, of a hollow
/// one its bore.
double countersink_mm(const PreparedPart& plan, std::size_t setup);

/// The least radius [mm] at which the tip of a tool clears the centre, in the program's
/// coordinates; (1) of live_centre.hpp.
double clear_of_centre_mm(const PreparedPart& plan, std::size_t setup,
                          const catalogue::Tool& tool, double z_mm);

}  // namespace turnwright::planning
