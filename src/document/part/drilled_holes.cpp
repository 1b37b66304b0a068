#include <algorithm>
#include <stdexcept>
#include <string>

#include "part_sections.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/planning/plan_request.hpp"
#include "turnwright/tolerance/general.hpp"
#include "turnwright/tolerance/iso286.hpp"

namespace turnwright::document {
namespace {

using catalogue::FixedTool;
using catalogue::FixedUse;

// Whether a JSON value, or a member of it at any depth, is this text.
bool names(const nlohmann::json& value, const std::string& id) {
  if (value.is_string()) return value.get_ref<const std::string&>() == id;
  return value.is_structured() &&
         std::any_of(value.begin(), value.end(),
                     [&](const auto& v) { return names(v, id); });
}

// Limits of a bore's size; of an open one the narrowest that a drawing in general has.
part::Limits limits_of(const part::InnerElement& bore) {
  return bore.limits
             ? *bore.limits
             : tolerance::general_limits_mm(bore.left_mm, tolerance::LinearClass::f);
}

bool has_size(const FixedTool& drill, double D) {
  return std::ranges::find(drill.sizes_mm, D) != drill.sizes_mm.end();
}

bool keeps_size(const FixedTool& drill, double D, const part::Limits& limits) {
  const auto grade =
      tolerance::Grade(static_cast<int>(tolerance::Grade::IT0) + drill.hole->grade);
  return limits.lower_mm <= 0 &&
         units::um_from_mm(limits.upper_mm) >= tolerance::it_um(D, grade);
}

// Whether a drill leaves a bore as it is drawn.
bool keeps(const FixedTool& drill, const part::InnerElement& bore, double depth_mm) {
  const double D = bore.left_mm;
  return has_size(drill, D) && depth_mm <= drill.reach * D &&
         keeps_size(drill, D, limits_of(bore)) &&
         bore.Ra_um.value_or(drill.hole->Ra_um) >= drill.hole->Ra_um && !bore.Rz_um;
}

// What a drill is known to leave.
std::string promise(const FixedTool& drill) {
  return "IT" + std::to_string(drill.hole->grade) + " and Ra " +
         number_text(drill.hole->Ra_um) + " um";
}

// Whether a boring bar enters what a drill would leave of a bore.
bool can_be_bored(const std::vector<catalogue::Tool>& tools, double diameter_mm) {
  return std::ranges::any_of(tools, [&](const catalogue::Tool& t) {
    return t.bar && t.bar->min_bore_mm <= diameter_mm - 2 * planning::kLeftToBore_mm;
  });
}

// The drills of the material of which it is known what they leave.
std::vector<const FixedTool*> known_drills(const Draft& draft) {
  std::vector<const FixedTool*> all;
  const auto& plan = draft.loaded.plan;
  for (const auto& t : plan.fixed_tools)
    if (t.use == FixedUse::drilling && t.hole && t.conditions_in(plan.material.group))
      all.push_back(&t);
  return all;
}

// The drill that makes a bore to its size; none.
const FixedTool* drill_of(const Draft& draft, const part::InnerElement& bore,
                          double depth_mm) {
  for (const auto* t : known_drills(draft))
    if (keeps(*t, bore, depth_mm)) return t;
  return nullptr;
}

bool plain(const part::InnerElement& e) {
  return !e.cut && e.kind == part::ElementKind::cylinder && !e.left_chamfer &&
         !e.right_chamfer && !e.left_fillet_mm && !e.right_fillet_mm;
}

// The bores of an end of a bar, outermost first.
struct Bores {
  std::vector<std::size_t> all;
  double depth_mm = 0;
};
Bores bores_of(const part::Drawing& d, part::End end) {
  Bores bores;
  for (std::size_t i = 0; i < d.inner.size(); ++i)
    if (d.inner[i].from == end) {
      bores.all.push_back(i);
      bores.depth_mm += d.inner[i].length_mm;
    }
  return bores;
}

// Whether the innermost bore is so narrow that boring still cuts all others.
bool leaves_the_others(const part::Drawing& d, const Bores& bores) {
  const double D = d.inner[bores.all.back()].left_mm;
  return std::all_of(bores.all.begin(), bores.all.end() - 1, [&](std::size_t i) {
    return std::min(d.inner[i].left_mm, d.inner[i].right_mm) >=
           D + 2 * planning::kLeftToBore_mm;
  });
}

// The limits that a hole of the document is given, if they can be read.
std::optional<part::Limits> given_limits(Reader& hole, double D) {
  if (const auto given = hole.find("limits_mm"))
    return given->broken() ? std::nullopt : std::optional(read_limits(hole));
  const auto fit = hole.optional_text("fit", 8);
  if (!fit) return std::nullopt;
  try {
    return tolerance::fit_limits_mm(D, *fit);
  } catch (const std::domain_error& error) {
    hole.problem_at("fit",
                    std::string("an ISO 286 tolerance class (") + error.what() + ")",
                    "choice");
    return std::nullopt;
  }
}

// A hole is not asked for more than some drill of its diameter leaves.
void check_demands(const Draft& draft, Reader hole, double D) {
  auto drills = known_drills(draft);
  std::erase_if(drills, [&](const auto* t) { return !has_size(*t, D); });
  if (drills.empty()) return;
  const auto refuse = [&](const char* key) {
    std::string made;
    for (const auto* t : drills)
      made += (made.empty() ? "" : "; ") + t->id + " " + promise(*t);
    hole.problem_at(key,
                    "no more than a drill leaves (" + made +
                        "), or \"cylinder\" as kind, which is bored",
                    "conflict");
  };
  const auto none = [&](const auto& leaves) {
    return std::ranges::none_of(drills, leaves);
  };
  if (const auto limits = given_limits(hole, D);
      limits && none([&](const auto* t) { return keeps_size(*t, D, *limits); }))
    refuse(hole.has("fit") ? "fit" : "limits_mm");
  if (const auto Ra_um = hole.optional_number("Ra_um", above_up_to(0, 100, "um"));
      Ra_um && none([&](const auto* t) { return t->hole->Ra_um <= *Ra_um; }))
    refuse("Ra_um");
}

// The holes that the document asks for.
void check_holes(const Draft& draft, const std::vector<Reader>& items,
                 const Bores& bores) {
  const auto& d = draft.loaded.plan.drawing;
  for (const std::size_t i : bores.all) {
    if (!part::is_hole(d.inner[i])) continue;
    if (d.stock.kind != part::StockKind::bar)
      items[i].problem_at("kind", "a bore: a tube is not drilled", "conflict");
    else if (i != bores.all.back() || !leaves_the_others(d, bores))
      items[i].problem_at("kind",
                          "a hole that is the innermost bore of its end, at least 1 mm "
                          "narrower than the others",
                          "conflict");
    else
      check_demands(draft, items[i], d.inner[i].left_mm);
  }
}

}  // namespace

void read_drilled_holes(Draft& draft) {
  auto& d = draft.drawing();
  if (!sizes_were_read(d) || d.inner.empty()) return;
  const bool given = draft.root.has("operations") &&
                     draft.root.at("operations").json() != nlohmann::json("auto");
  const auto named = draft.root.find("tolerances");
  const auto items = draft.root.at("inner").as_items(0, d.inner.size());
  for (const auto end : {part::End::left, part::End::right}) {
    const auto bores = bores_of(d, end);
    if (bores.all.empty()) continue;
    check_holes(draft, items, bores);
    auto& bore = d.inner[bores.all.back()];
    if (given || !plain(bore) || can_be_bored(draft.plan().tools, bore.left_mm) ||
        d.stock.kind != part::StockKind::bar ||
        (named && names(named->json(), bore.id)) || !leaves_the_others(d, bores))
      continue;
    const auto* drill = drill_of(draft, bore, bores.depth_mm);
    if (!drill) continue;
    const Reader& item = items[bores.all.back()];
    draft.assume(item.pointer_of("kind"), "hole",
                 "drilled to its size by " + drill->id + ", to " + promise(*drill));
    make_at_catalogue_conditions(draft, item, bore, part::hole(bore.left_mm).cut);
  }
}

}  // namespace turnwright::document
