#include "tool_label.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace turnwright::planning {
namespace {

// Diameter of the chamfer that a countersink cuts: where the hole begins, by what it takes
// off, else where it leaves the part.
double countersunk_mm(const part::InnerElement& hole, const OperationPlan& o) {
  constexpr double kSame_mm = 1e-9;
  const auto& opening = part::opening_chamfer(hole);
  if (opening) {
    const double D = hole.left_mm + 2 * opening->radial_mm;
    const double taken = (D - part::opened_mm(*hole.cut)) / 2;
    if (std::abs(o.passes[0].ap_mm - taken) < kSame_mm) return D;
  }
  return hole.left_mm + 2 * part::closing_chamfer(hole)->radial_mm;
}

}  // namespace

std::string tool_label(const PlanRequest& p, const OperationPlan& o) {
  if (o.kind == OperationKind::cross_drill)
    return fmt::format("{} {:g} mm, driven", o.tool, 2 * o.passes[0].ap_mm);
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
    const double D = countersunk_mm(*bore, o);
    return fmt::format("{} {:g} mm", o.tool,
                       *std::ranges::lower_bound(tool->sizes_mm, D));
  }
  if (tool->use == FixedUse::reaming || tool->use == FixedUse::counterboring)
    return fmt::format("{} {:g} mm", o.tool, bore->cut->drawn.left_mm);
  const bool round = catalogue::on_axis(tool->use);
  return fmt::format("{} {:g} mm", o.tool, (round ? 2 : 1) * o.passes[0].ap_mm);
}

}  // namespace turnwright::planning
