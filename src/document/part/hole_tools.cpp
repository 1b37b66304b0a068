#include "hole_tools.hpp"

#include <algorithm>
#include <cmath>

#include "base/say.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/part/thread.hpp"
#include "turnwright/tolerance/iso286.hpp"

namespace turnwright::document {

using catalogue::FixedTool;
using catalogue::FixedUse;

namespace {

// The tools for a use in the plan's material.
std::vector<const FixedTool*> tools_for(const Draft& draft, FixedUse use) {
  std::vector<const FixedTool*> all;
  const auto& plan = draft.loaded.plan;
  for (const auto& t : plan.fixed_tools)
    if (t.use == use && t.conditions_in(plan.material.group)) all.push_back(&t);
  return all;
}

bool keeps(const FixedTool& tool, const HoleDemand& w) {
  return (!w.limits || keeps_size(tool, w.D_mm, *w.limits)) &&
         w.Ra_um.value_or(tool.hole->Ra_um) >= tool.hole->Ra_um;
}

// The drill's size between two limits, nearest to a third one, that goes deep enough.
std::optional<double> drill_between(const Draft& draft, const HoleDemand& w,
                                    double least_mm, double most_mm, double best_mm,
                                    double beyond_mm) {
  std::optional<double> found;
  for (const auto* t : tools_for(draft, FixedUse::drilling))
    for (const double size : t->sizes_mm) {
      const double deep = w.drilled_to_mm + beyond_mm;
      if (size < least_mm - kRounding_mm || size > most_mm + kRounding_mm ||
          !w.takes_drill(size) || deep > t->reach * size)
        continue;
      if (!found || std::abs(size - best_mm) < std::abs(*found - best_mm)) found = size;
    }
  return found;
}

// Whether a countersink cuts the chamfer of a counterbore, if it has one, before its cone
// meets the floor.
bool spares_floor(const Draft& draft, std::size_t i, const HoleDemand& w) {
  const auto& d = draft.loaded.plan.drawing;
  const auto& c = part::opening_chamfer(d.inner[i]);
  if (!c) return true;
  const double D = w.D_mm + 2 * c->radial_mm;
  const auto* t = countersink_for(draft, part::way_in_mm(d, i), D, &*c);
  return t && (D - *w.drill_mm) / 2 / std::tan(units::rad_from_deg(t->point_deg / 2)) <=
                  w.length_mm + kRounding_mm;
}

}  // namespace

bool has_size(const FixedTool& drill, double D) {
  return std::ranges::find(drill.sizes_mm, D) != drill.sizes_mm.end();
}

bool keeps_size(const FixedTool& drill, double D, const part::Limits& limits) {
  const auto grade =
      tolerance::Grade(static_cast<int>(tolerance::Grade::IT0) + drill.hole->grade);
  return limits.lower_mm <= 0 &&
         units::um_from_mm(limits.upper_mm) >= tolerance::it_um(D, grade);
}

std::string promise(const FixedTool& drill) {
  return say("IT{} and Ra {} um", drill.hole->grade, number_text(drill.hole->Ra_um));
}

std::vector<const FixedTool*> known_tools(const Draft& draft, FixedUse use) {
  auto all = tools_for(draft, use);
  std::erase_if(all, [](const FixedTool* t) { return !t->hole; });
  return all;
}

std::optional<part::Limits> given_limits(Reader& hole, double D) {
  const auto before = hole.problems().list.size();
  if (hole.has("limits_mm")) {
    const auto given = read_limits(hole);
    return hole.problems().list.size() > before ? std::nullopt : std::optional(given);
  }
  const auto fit = hole.optional_text("fit", 8);
  if (!fit || hole.problems().list.size() > before) return std::nullopt;
  try {
    return tolerance::fit_limits_mm(D, *fit);
  } catch (const std::domain_error& error) {
    hole.problem_at("fit", say("an ISO 286 tolerance class ({})", error.what()),
                    "choice");
    return std::nullopt;
  }
}

std::optional<MadeHole> drilled_hole(const Draft& draft, const HoleDemand& w) {
  for (const auto* t : known_tools(draft, FixedUse::drilling))
    if (has_size(*t, w.D_mm) && w.takes_drill(w.D_mm) && keeps(*t, w) &&
        w.drilled_to_mm <= t->reach * w.D_mm)
      return MadeHole{part::hole(w.D_mm),
                      say("drilled to its size by {}, to {}", t->id, promise(*t)),
                      to_translate("drilled")};
  return std::nullopt;
}

std::optional<MadeHole> reamed_hole(const Draft& draft, const HoleDemand& w) {
  for (const auto* t : known_tools(draft, FixedUse::reaming)) {
    if (!has_size(*t, w.D_mm) || !keeps(*t, w) ||
        w.length_mm + t->lead > t->reach * w.D_mm)
      continue;
    const double least = w.D_mm - t->allowance_mm.upper,
                 most = w.D_mm - t->allowance_mm.lower;
    if (const auto drill = drill_between(draft, w, least, most, most, t->lead))
      return MadeHole{part::reamed(w.D_mm, *drill, t->lead),
                      say("drilled to {} mm and reamed by {}, to {}", number_text(*drill),
                          t->id, promise(*t)),
                      to_translate("reamed")};
  }
  return std::nullopt;
}

std::optional<MadeHole> tapped_hole(const Draft& draft, const HoleDemand& w) {
  const auto D1 = part::minor_diameter_6H(w.D_mm, w.pitch_mm);
  for (const auto* t : tools_for(draft, FixedUse::tapping)) {
    const double lead = t->lead * w.pitch_mm;
    if (!catalogue::thread_of(*t, w.D_mm, w.pitch_mm) ||
        w.length_mm + lead > t->reach * w.D_mm)
      continue;
    if (const auto drill = drill_between(draft, w, D1.least_mm, D1.most_mm,
                                         w.D_mm - w.pitch_mm, lead + w.pitch_mm))
      return MadeHole{
          part::tapped(w.D_mm, w.pitch_mm, *drill, lead),
          say("drilled to {} mm and tapped by {}", number_text(*drill), t->id),
          to_translate("tapped")};
  }
  return std::nullopt;
}

const FixedTool* countersink_for(const Draft& draft, double way_in_mm, double D_mm,
                                 const part::Chamfer* chamfer) {
  constexpr double kBeside_mm = 0.2;  // as planning asks in the bores before the hole
  const double room = way_in_mm - 2 * kBeside_mm;
  for (const auto* t : tools_for(draft, FixedUse::countersinking)) {
    const auto size = std::ranges::lower_bound(t->sizes_mm, D_mm);
    if (size != t->sizes_mm.end() && *size <= room &&
        (!chamfer || part::fits_countersink(*chamfer, t->point_deg)))
      return t;
  }
  return nullptr;
}

bool can_be_countersunk(const Draft& draft, std::size_t i) {
  const auto& d = draft.loaded.plan.drawing;
  const auto& e = d.inner[i];
  const auto cut = [&](const std::optional<part::Chamfer>& c, double way_in_mm) {
    return !c || countersink_for(draft, way_in_mm, e.left_mm + 2 * c->radial_mm, &*c);
  };
  return cut(part::opening_chamfer(e), part::way_in_mm(d, i)) &&
         (!part::closing_chamfer(e) || part::leaves_part(d, i)) &&
         cut(part::closing_chamfer(e), INFINITY);
}

std::optional<MadeHole> counterbored_hole(const Draft& draft, std::size_t i,
                                          const HoleDemand& w) {
  if (!w.drill_mm || !(w.D_mm > *w.drill_mm) || !spares_floor(draft, i, w))
    return std::nullopt;
  for (const auto* t : known_tools(draft, FixedUse::counterboring))
    if (has_size(*t, w.D_mm) && keeps(*t, w) && w.drilled_to_mm <= t->reach * w.D_mm)
      return MadeHole{part::counterbored(w.D_mm, *w.drill_mm),
                      say("opened from the drill's {} mm by {}, to {}",
                          number_text(*w.drill_mm), t->id, promise(*t)),
                      to_translate("counterbored")};
  return std::nullopt;
}

std::string why_not(const Draft& draft, const HoleDemand& w) {
  std::string all;
  const auto add = [&](const FixedTool& t, const std::string& why) {
    all += (all.empty() ? "" : "; ") + t.id + " " + why;
  };
  const auto usable = [&](const FixedTool& t) {
    return has_size(t, w.D_mm) && keeps(t, w);
  };
  for (const auto* t : known_tools(draft, FixedUse::drilling))
    if (usable(*t))
      add(*t, w.takes_drill(w.D_mm) ? say("reaches {} mm", number_text(t->reach * w.D_mm))
                                    : tr("is wider than the drill of what lies behind"));
  for (const auto* t : known_tools(draft, FixedUse::reaming)) {
    if (!usable(*t)) continue;
    if (w.length_mm + t->lead > t->reach * w.D_mm)
      add(*t, say("reaches {} mm with its lead", number_text(t->reach * w.D_mm)));
    else
      add(*t,
          say("asks for a drill of {} to {} mm that reaches, and makes what lies behind",
              number_text(w.D_mm - t->allowance_mm.upper),
              number_text(w.D_mm - t->allowance_mm.lower)));
  }
  for (const auto* t : known_tools(draft, FixedUse::counterboring))
    if (usable(*t))
      add(*t, say("opens a narrower hole behind, down to at most {} mm from the face",
                  number_text(t->reach * w.D_mm)));
  return all;
}

}  // namespace turnwright::document
