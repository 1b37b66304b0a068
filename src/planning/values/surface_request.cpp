#include "surface_request.hpp"

#include <algorithm>

namespace turnwright::planning {
namespace {

using catalogue::Tool;
using catalogue::ToolUse;

bool fits(const Tool& t, ToolUse use, catalogue::IsoGroup group) {
  return std::find(t.uses.begin(), t.uses.end(), use) != t.uses.end() &&
         std::find(t.groups.begin(), t.groups.end(), group) != t.groups.end();
}

const Tool* tool_named(const PlanRequest& p, const std::optional<std::string>& id) {
  if (!id) return nullptr;
  for (const auto& t : p.tools)
    if (t.id == *id) return &t;
  return nullptr;
}

}  // namespace

std::vector<const Tool*> tools_for(const PlanRequest& p, ToolUse use) {
  std::vector<const Tool*> all;
  for (const auto& t : p.tools)
    if (fits(t, use, p.material.group)) all.push_back(&t);
  return all;
}

SurfaceRequest surface_request(const PlanRequest& p, std::size_t setup,
                               const std::string& surface) {
  SurfaceRequest w;
  if (!p.operations) return w;
  w.given = true;
  w.rough = w.finish = false;
  for (const auto& o : *p.operations) {
    if (o.setup != setup || o.kind == OperationKind::fixed ||
        std::find(o.on.begin(), o.on.end(), surface) == o.on.end())
      continue;
    const bool rough =
        o.kind == OperationKind::rough || o.kind == OperationKind::bore_rough;
    (rough ? w.rough : w.finish) = true;
    (rough ? w.rough_tool : w.finish_tool) = tool_named(p, o.tool);
    (rough ? w.fixed.rough : w.fixed.finish) = o.conditions;
    (rough ? w.fixed.rough_direction : w.fixed.finish_direction) = o.direction;
    const std::string id = o.on.size() > 1 ? o.id + ":" + surface : o.id;
    w.ids.insert(rough ? w.ids.begin() : w.ids.end(), id);
  }
  return w;
}

}  // namespace turnwright::planning
