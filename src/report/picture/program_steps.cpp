#include "program_steps.hpp"

#include <stdexcept>

namespace turnwright::report {

std::vector<PlannedStep> planned_steps(const planning::SetupPlan& setup,
                                       const toolpath::SetupProgram& program) {
  std::vector<PlannedStep> all;
  auto next = setup.operations.begin();
  for (const auto& step : program.steps) {
    if (next == setup.operations.end())
      throw std::domain_error("planned_steps: the program has more steps than the plan");
    all.push_back({&step, &*next});
    const bool mills = planning::is_driven(next->kind);
    if (step.stop ? mills && step.stop_min == 0 : mills == step.milling.has_value())
      ++next;
  }
  if (next != setup.operations.end())
    throw std::domain_error("planned_steps: the program does not make " + next->id);
  return all;
}

}  // namespace turnwright::report
