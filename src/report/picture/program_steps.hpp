#pragma once
#include <vector>

#include "turnwright/nc/program.hpp"

namespace turnwright::report {

/// A step of a program and the plan's operation: the one it makes or, of a stop to change
/// the clamping, the one that follows.
struct PlannedStep {
  const toolpath::Step* step = nullptr;
  const planning::OperationPlan* operation = nullptr;
};

/// The steps in their order.  A milled place that the program does not mill is a stop that
/// takes no time in it.
/// @throws std::domain_error if the program does not make the setup's operations.
std::vector<PlannedStep> planned_steps(const planning::SetupPlan& setup,
                                       const toolpath::SetupProgram& program);

}  // namespace turnwright::report
