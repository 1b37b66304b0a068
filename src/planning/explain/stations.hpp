#pragma once
#include <optional>

#include "turnwright/planning/prepared_part.hpp"
#include "turnwright/planning/process_plan.hpp"

/// Stations of the turret, of which a machine may have too few for the tools of a setup.
namespace turnwright::planning {

/// The fewest stations, more than the machine has, for which some tools make every surface;
/// none if no tools do.
std::optional<int> stations_needed(const PreparedPart& part);

/// Adds them to what would have to be relaxed.
void add_stations_needed(const PreparedPart& part, ProcessPlan& result);

/// The same for a part that cannot be made although there are stations for some tools, with
/// the conflict; nothing where others do not make it either.
void add_lack_of_stations(const PreparedPart& part, ProcessPlan& result);

}  // namespace turnwright::planning
