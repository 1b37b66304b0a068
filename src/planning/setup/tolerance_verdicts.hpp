#pragma once
#include <optional>
#include <vector>

#include "solved_setup.hpp"

/// What becomes of the tolerances at the solution, and of the surfaces' errors.
namespace turnwright::planning {

/// Predicted and allowed values of every tolerance of the drawing, at the solution; the
/// worst of new and worn roughing and finishing edges where the plan counts their wear.
std::vector<ToleranceResult> tolerance_results(const PreparedPart& plan,
                                               const std::vector<SolvedSetup>& setups);

/// The error of every finished surface at 21 positions, offset and correction included;
/// blanks are left out.  With wear of edges also where these are changed.
std::vector<Deviation> deviations(const PreparedPart& plan,
                                  const std::vector<SolvedSetup>& setups);

/// Constant offsets of the tool at the surfaces whose sizes need one.
std::vector<ToolOffset> offsets(const PreparedPart& plan,
                                const std::vector<SolvedSetup>& setups);

/// Corrections of the tool path at the surfaces whose tolerances need one.
std::vector<Compensation> compensations(const std::vector<SolvedSetup>& setups);

/// The tolerance that the fewest parts keep; the first one if there are several.
std::optional<WorstConformance> worst_conformance(
    const PlanRequest& plan, const std::vector<ToleranceResult>& tolerances);

}  // namespace turnwright::planning
