#include "tool_label.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace turnwright::planning {

std::string tool_label(const PlanRequest& p, const OperationPlan& o) {
  if (o.kind != OperationKind::fixed) return o.tool;
  const auto tool = std::ranges::find(p.fixed_tools, o.tool, &catalogue::FixedTool::id);
  if (tool == p.fixed_tools.end()) return o.tool;
  using catalogue::FixedUse;
  const auto bore = std::ranges::find(p.drawing.inner, o.on[0], &part::InnerElement::id);
  if (tool->use == FixedUse::tapping)
    return o.tool + ' ' +
           catalogue::thread_of(*tool, bore->cut->drawn.left_mm, bore->cut->pitch_mm)
               ->designation;
  if (tool->sizes_mm.empty()) return o.tool;
  if (tool->use == FixedUse::countersinking) {
    const double D = bore->left_mm + 2 * part::opening_chamfer(*bore)->radial_mm;
    return fmt::format("{} {:g} mm", o.tool,
                       *std::ranges::lower_bound(tool->sizes_mm, D));
  }
  if (tool->use == FixedUse::reaming || tool->use == FixedUse::counterboring)
    return fmt::format("{} {:g} mm", o.tool, bore->cut->drawn.left_mm);
  const bool round = catalogue::on_axis(tool->use);
  return fmt::format("{} {:g} mm", o.tool, (round ? 2 : 1) * o.passes[0].ap_mm);
}

}  // namespace turnwright::planning
