#pragma once
#include <string>
#include <vector>

#include "turnwright/planning/prepared_part.hpp"
#include "turnwright/planning/process_plan.hpp"

/// How factors on the models' constants move the sizes of a planned part.
namespace turnwright::planning {

/// One finished cylinder or cone.
struct FactorEffect {
  std::string surface, tool;
  std::size_t setup = 0;
  double made_mm = 0;  ///< deviation of its diameter as planned, offset included
  /// Changes of the diameter [mm] per change of the logarithm of all passive forces, and of
  /// all compliances of what holds part and tool, with path and offset as planned.
  double by_force_mm = 0, by_compliance_mm = 0;
  /// Of the diameter per part, by the recession of the edge, positive where it grows.
  double wear_mm_part = 0;
  double edges_per_part = 0;  ///< of the tool's edge that one part uses up
};

/// Of every surface that the plan finishes by turning; none of a plan that is not feasible.
/// Differences of predictions with forces and compliances 5 % larger, which neither offset
/// nor path follows.  The middle of the largest and the least error of a surface counts.
/// Source: derived here, checked in factor_effects_test against predictions.
std::vector<FactorEffect> factor_effects(const PreparedPart& part,
                                         const ProcessPlan& plan);

}  // namespace turnwright::planning
