#include "tool_label.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace turnwright::planning {

std::string tool_label(const PlanRequest& p, const OperationPlan& o) {
  if (o.kind != OperationKind::fixed) return o.tool;
  const auto tool = std::ranges::find(p.fixed_tools, o.tool, &catalogue::FixedTool::id);
  if (tool == p.fixed_tools.end() || tool->sizes_mm.empty()) return o.tool;
  using catalogue::FixedUse;
  const bool round = tool->use == FixedUse::centring || tool->use == FixedUse::drilling;
  return fmt::format("{} {:g} mm", o.tool, (round ? 2 : 1) * o.passes[0].ap_mm);
}

}  // namespace turnwright::planning
