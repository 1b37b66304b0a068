#pragma once
#include <string>
#include <vector>

#include "planning/surface/operation_result.hpp"

/// Which limits of a request stand behind the rows of a solved surface.
namespace turnwright::planning {

/// The limits that a row may stand for, by name.
std::vector<std::string> limit_names(const PreparedPart& part,
                                     const SolvedSurface& feature, const Row& row);

/// Those that hold the spindle while an operation that is clamped by it is cut.
std::vector<std::string> spindle_limit_names(const PreparedPart& part,
                                             const SolvedSurface& feature,
                                             std::size_t operation);

}  // namespace turnwright::planning
