#pragma once
#include <string>

#include "planning/surface/operation_result.hpp"

/// Why a surface cannot be made.
namespace turnwright::planning {

/// One sentence with the limit that keeps this surface from being made, and by how much.
std::string infeasibility_reason(const PreparedPart& plan, const SolvedSurface& feature);

/// The conflict of a tolerance that the sources other than the cut use up.
Conflict used_up_conflict(const PreparedPart& plan, const SolvedSurface& feature,
                          const CutTolerance& cut_tolerance);

}  // namespace turnwright::planning
