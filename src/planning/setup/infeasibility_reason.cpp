#include "infeasibility_reason.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/say.hpp"
#include "planning/values/readable.hpp"
#include "planning/values/surface_request.hpp"
#include "turnwright/planning/limit_words.hpp"

namespace turnwright::planning {
namespace {

struct Worst {
  double g = -std::numeric_limits<double>::infinity();
  RowValue row;
};

Worst worst_row(const RecipeModel& m, const Choice<double>& c) {
  Worst w;
  for (const auto& r : m.values(c))
    if (violation(r) > w.g) w = {violation(r), r};
  return w;
}

// Whether a tool that could rough or finish a surface meets the tailstock's centre.
bool meets_centre(const PreparedPart& plan, const MachinedSurface& f) {
  for (const auto use : {catalogue::ToolUse::roughing, catalogue::ToolUse::finishing})
    for (const auto* tool : tools_for(plan, use))
      if (!f.clears_centre(*tool)) return true;
  return false;
}

std::string why_none(const PreparedPart& plan, const MachinedSurface& f) {
  const auto& fixed = f.fixed();
  const auto use = f.last_use();
  if (!plan.operations && tools_for(plan, use).empty())
    return say(": none of the tools for {} has a grade for {}",
               use == catalogue::ToolUse::facing   ? tr("facing")
               : use == catalogue::ToolUse::boring ? tr("boring")
                                                   : tr("finishing"),
               plan.material.id);
  if (const auto asked = f.edges_asked(); !asked.empty())
    return say(": no tool that could finish it fits and has {}", asked);
  if (!f.is_shoulder() && !(f.stock_mm() > 0))
    return tr(": the stock does not stand above the middle of its limits");
  if (fixed.rough.ap_mm || fixed.finish.ap_mm)
    return say(": the given passes do not add up to the {} mm to take off",
               readable(f.stock_mm()));
  if (f.by_bar())
    return tr(
        ": no boring bar is thin and long enough, or none can cut the depth that is "
        "left");
  if (const auto& c = plan.machine.live_centre; meets_centre(plan, f))
    return say(
        ": no tools that clear the live centre, with a point of {:g} mm and a body of "
        "{:g} mm {:g} mm behind its tip, give a depth they can cut",
        c.point_mm, c.body_mm, c.point_length_mm);
  return tr(": no tool and number of passes up to 1000 give a depth its tool can cut");
}

}  // namespace

Conflict used_up_conflict(const PreparedPart& plan, const SolvedSurface& f,
                          const CutTolerance& d) {
  const auto& t = plan.drawing.tolerances[d.tolerance];
  std::string sources;
  for (const auto& s : shares(tolerance_allocation(plan, d.tolerance, f.task.making)))
    sources +=
        fmt::format("{}{} {:.3g} um", sources.empty() ? "" : ", ", tr(s.source), s.um);
  const auto called = t.id + " " + part::name(t.kind);
  const auto [taken, width] = readable_apart(d.taken_mm, width_mm(t));
  return {called,
          f.task.feature.surface(),
          d.taken_mm,
          width_mm(t),
          "mm",
          say("{} of {}: without the cut {} of its {} mm are used up ({})",
              limit_words(called), f.task.feature.surface(), taken, width, sources)};
}

std::string infeasibility_reason(const PreparedPart& plan, const SolvedSurface& f) {
  const auto& feature = f.task.feature;
  if (const auto* d = used_up(f.task.cut_tolerances); d && !f.answer.model)
    return used_up_conflict(plan, f, *d).sentence;
  if (!f.answer.model) return feature.surface() + why_none(plan, feature);
  const auto& m = *f.answer.model;
  const auto w = worst_row(m, f.answer.choice);
  const auto c = constraint(plan, m.chain(), f.answer.choice, w.row);
  return say("{}, {:.1f} % over at the nearest conditions found",
             exceeded(feature.surface(), c),
             100 * (either_sign(w.row.row.check) ? w.g : std::expm1(w.g)));
}

}  // namespace turnwright::planning
