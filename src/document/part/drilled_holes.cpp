#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "base/say.hpp"
#include "hole_tools.hpp"
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

// Limits of a bore's size; of an open one the narrowest that a drawing in general has, none
// below the sizes of ISO 2768-1.
std::optional<part::Limits> limits_of(const part::InnerElement& bore) try {
  return bore.limits
             ? bore.limits
             : tolerance::general_limits_mm(bore.left_mm, tolerance::LinearClass::f);
} catch (const std::domain_error&) {
  return std::nullopt;
}

// Whether a boring bar enters a diameter.
bool bar_enters(const Draft& draft, double diameter_mm) {
  return std::ranges::any_of(draft.loaded.plan.tools, [&](const catalogue::Tool& t) {
    return t.bar && t.bar->min_bore_mm <= diameter_mm;
  });
}

// Whether a boring bar enters what the drill would leave of a bore; into a counterbore it
// has to enter the hole behind.
bool can_be_bored(const Draft& draft, const part::InnerElement& bore,
                  const MadeHole& hole) {
  const auto& cut = hole.shape.cut;
  return bar_enters(
      draft, cut.flat ? cut.drilled_mm : bore.left_mm - 2 * planning::kLeftToBore_mm);
}

// Whether a boring bar and a threading tool enter what the drill would leave of a thread.
bool can_be_threaded(const Draft& draft, const part::InnerElement& thread) {
  const auto& plan = draft.loaded.plan;
  return bar_enters(draft, thread.left_mm - 2 * planning::kLeftToBore_mm) &&
         std::ranges::any_of(plan.fixed_tools, [&](const FixedTool& t) {
           return t.use == FixedUse::threading && t.inner &&
                  t.conditions_in(plan.material.group) &&
                  t.min_bore_mm <= thread.left_mm &&
                  t.pitch_mm.lower <= thread.cut->pitch_mm &&
                  thread.cut->pitch_mm <= t.pitch_mm.upper;
         });
}

bool is_thread(const part::InnerElement& e) {
  return e.cut && e.cut->kind == part::CutKind::thread;
}

// Whether the drawing asks for a roughness or a tolerance of the shoulder where a bore ends.
bool has_demanding_shoulder(const Draft& draft, std::size_t i) {
  const auto& d = draft.loaded.plan.drawing;
  const auto tolerances = draft.root.find("tolerances");
  return std::ranges::any_of(part::inner_shoulders(d), [&](const auto& s) {
    return s.wider == i &&
           (std::ranges::find(d.faces, s.id, &part::Face::id) != d.faces.end() ||
            (tolerances &&
             (names(tolerances->json(), s.id) || names(tolerances->json(), s.reversed))));
  });
}

// Without other edges than chamfers that countersinks cut, and without demands on its
// shoulder.
bool plain(const Draft& draft, std::size_t i) {
  const auto& d = draft.loaded.plan.drawing;
  const auto& e = d.inner[i];
  return !has_demanding_shoulder(draft, i) && e.kind == part::ElementKind::cylinder &&
         !e.left_fillet_mm && !e.right_fillet_mm && can_be_countersunk(draft, i);
}

// Indices of the bores of an end of a bar, outermost first.
using Bores = std::vector<std::size_t>;
Bores bores_of(const part::Drawing& d, part::End end) {
  Bores bores;
  for (std::size_t i = 0; i < d.inner.size(); ++i)
    if (d.inner[i].from == end) bores.push_back(i);
  return bores;
}

// What the drill of the k-th bore of an end has to do; `behind` is the hole that it goes on
// to make.
HoleDemand wanted(const part::Drawing& d, const Bores& bores, std::size_t k,
                  const std::optional<MadeHole>& behind) {
  HoleDemand w;
  const auto& e = d.inner[bores[k]];
  w.D_mm = is_thread(e) ? e.cut->drawn.left_mm : e.left_mm;
  w.length_mm = e.length_mm;
  if (e.cut) w.pitch_mm = e.cut->pitch_mm;
  for (std::size_t i = 0; i <= k; ++i) w.drilled_to_mm += d.inner[bores[i]].length_mm;
  if (behind) w.drill_mm = behind->shape.cut.drilled_mm;
  return w;
}

// Refuses what is asked of a hole and no drill or reamer of its diameter leaves.
void refuse_demands(const Draft& draft, Reader hole, const HoleDemand& w) {
  auto tools = known_tools(draft, FixedUse::drilling);
  for (const auto use : {FixedUse::reaming, FixedUse::counterboring})
    for (const auto* t : known_tools(draft, use)) tools.push_back(t);
  std::erase_if(tools, [&](const auto* t) { return !has_size(*t, w.D_mm); });
  if (tools.empty()) return;
  const auto refuse = [&](const char* key) {
    std::string made;
    for (const auto* t : tools)
      made += (made.empty() ? "" : "; ") + t->id + " " + promise(*t);
    hole.problem_at(key,
                    say("no more than a drill, a flat drill or a reamer leaves ({}), or "
                        "\"cylinder\" as kind, which is bored",
                        made),
                    "conflict");
  };
  const auto none = [&](const auto& leaves) {
    return std::ranges::none_of(tools, leaves);
  };
  if (w.limits && none([&](const auto* t) { return keeps_size(*t, w.D_mm, *w.limits); }))
    refuse(hole.has("fit") ? "fit" : "limits_mm");
  if (w.Ra_um && none([&](const auto* t) { return t->hole->Ra_um <= *w.Ra_um; }))
    refuse("Ra_um");
}

// A hole that the document asks for; none if the drill of what lies behind does not make it.
std::optional<MadeHole> asked_hole(const Draft& draft, Reader item, std::size_t i,
                                   HoleDemand w) {
  if (!plain(draft, i))
    item.problem_at("kind",
                    tr("\"cylinder\" as kind, which is bored, or no other edges than "
                       "chamfers where the hole begins or leaves the part, of the angle "
                       "of a countersink of the tools"),
                    "conflict");
  w.limits = given_limits(item, w.D_mm);
  w.Ra_um = item.optional_number("Ra_um", above_up_to(0, 100, "um"));
  if (w.limits || w.Ra_um) {
    if (drilled_hole(draft, w)) return MadeHole{part::hole(w.D_mm), "", "drilled"};
    if (auto reamed = reamed_hole(draft, w)) return reamed;
    if (auto flat = counterbored_hole(draft, i, w)) return flat;
    const auto before = item.problems().list.size();
    refuse_demands(draft, item, w);
    const auto why = why_not(draft, w);
    if (!why.empty() && item.problems().list.size() == before)
      item.problem_at(w.limits ? item.has("fit") ? "fit" : "limits_mm" : "Ra_um",
                      say("what the tools can keep here: {}", why), "conflict");
  }
  if (!w.takes_drill(w.D_mm)) return counterbored_hole(draft, i, w);
  return MadeHole{part::hole(w.D_mm), "", "drilled"};
}

// Whether the operations are given.
bool are_given(const Draft& draft) {
  const auto given = draft.root.find("operations");
  return given && given->is_array();
}

// Whether the operations are the planner's, or none of them bores a bore and one drills it
// or another bore of its end.
bool drilled_by_operations(const Draft& draft, const part::InnerElement& bore) {
  if (!are_given(draft)) return true;
  bool drilled = false;
  for (const auto& o : draft.root.at("operations").json()) {
    if (!o.is_object()) continue;
    const auto on = o.value("on", nlohmann::json());
    const bool fixed = o.value("kind", nlohmann::json()) == "fixed";
    if (names(on, bore.id) && !fixed) return false;
    drilled = drilled ||
              (fixed &&
               std::ranges::any_of(draft.loaded.plan.drawing.inner, [&](const auto& e) {
                 return e.from == bore.from && names(on, e.id);
               }));
  }
  return drilled;
}

// A bore as tools on the axis make it, where they leave it as it is drawn.  With operations
// that are the planner's and a boring bar that enters, it is noted that it may be bored as well.
std::optional<MadeHole> fitting_hole(Draft& draft, std::size_t i, HoleDemand w) {
  const auto& plan = draft.loaded.plan;
  const auto& bore = plan.drawing.inner[i];
  const auto named = draft.root.find("tolerances");
  if (!plain(draft, i) || (bore.cut && !is_thread(bore)) || bore.Rz_um ||
      !drilled_by_operations(draft, bore) || (named && names(named->json(), bore.id)))
    return std::nullopt;
  if (is_thread(bore))
    return can_be_threaded(draft, bore) ? std::nullopt : tapped_hole(draft, w);
  w.limits = limits_of(bore);
  w.Ra_um = bore.Ra_um;
  auto hole = drilled_hole(draft, w);
  if (!hole) hole = counterbored_hole(draft, i, w);
  if (!hole) hole = reamed_hole(draft, w);
  if (!hole || are_given(draft) || !can_be_bored(draft, bore, *hole)) return hole;
  draft.loaded.drillable.push_back({i, hole->word});
  return std::nullopt;
}

// Whether the tools of the holes behind pass through a hole.
bool lets_pass(const MadeHole& hole, const std::vector<MadeHole>& behind) {
  return std::ranges::all_of(behind, [&](const MadeHole& h) {
    return h.shape.cut.drawn.left_mm <= hole.shape.blank.left_mm + kRounding_mm;
  });
}

// The holes of an end of a bar, innermost first: one drill makes them all.
std::vector<MadeHole> holes_of(Draft& draft, const std::vector<Reader>& items,
                               const Bores& bores) {
  const auto& d = draft.loaded.plan.drawing;
  std::vector<MadeHole> holes;
  std::optional<MadeHole> behind;
  for (std::size_t k = bores.size(); k-- > 0;) {
    const std::size_t i = bores[k];
    const auto w = wanted(d, bores, k, behind);
    behind = part::is_hole(d.inner[i]) ? asked_hole(draft, items[i], i, w)
                                       : fitting_hole(draft, i, w);
    if (!behind || !lets_pass(*behind, holes)) break;
    holes.push_back(*behind);
  }
  return holes;
}

// Whether boring still cuts the bores before the holes, and their tools pass through them.
bool leave_the_others(const part::Drawing& d, const Bores& bores,
                      const std::vector<MadeHole>& holes) {
  double least_mm = 0;
  for (const auto& hole : holes) {
    const auto& cut = hole.shape.cut;
    least_mm = std::max({least_mm, part::opened_mm(cut) + 2 * planning::kLeftToBore_mm,
                         cut.drawn.left_mm});
  }
  return std::all_of(bores.begin(), bores.end() - std::ssize(holes), [&](std::size_t i) {
    return std::min(d.inner[i].left_mm, d.inner[i].right_mm) >= least_mm;
  });
}

// A tapped hole without a chamfer is countersunk a little wider than its thread, as far as
// what it begins at leaves room.
// Source: DIN 76-1: one to 1.05 times the thread's diameter.
void countersink_tapped(Draft& draft, const Reader& item, std::size_t i) {
  constexpr double kOfThread = 1.05, kRing_mm = 0.2;
  auto& d = draft.drawing();
  auto& bore = d.inner[i];
  const bool left = bore.from == part::End::left;
  const double D = std::round(100 * kOfThread * bore.cut->drawn.left_mm) / 100;
  const double end_mm = left ? d.outer.front().left_mm : d.outer.back().right_mm;
  const auto* t = countersink_for(draft, part::way_in_mm(d, i), D, nullptr);
  if (part::opening_chamfer(bore) || !t || D + 2 * kRing_mm > end_mm) return;
  const double radial = (D - bore.cut->drilled_mm) / 2;
  const double axial = radial / std::tan(units::rad_from_deg(t->point_deg / 2));
  if (!(axial < bore.length_mm)) return;
  (left ? bore.left_chamfer : bore.right_chamfer) = part::Chamfer{axial, radial};
  draft.assume(item.pointer_of("kind"), {{"countersunk_to_mm", D}},
               say("1.05 times the thread's diameter (DIN 76-1), by {}", t->id));
}

void make(Draft& draft, const Reader& item, std::size_t i, const MadeHole& hole) {
  auto& bore = draft.drawing().inner[i];
  if (hole.how.empty()) return;  // as the document has it
  draft.assume(item.pointer_of("kind"), is_thread(bore) ? "thread" : "hole", hole.how);
  const bool asked = part::is_hole(bore);
  const auto fit = asked ? Reader(item).optional_text("fit", 8) : bore.fit;
  if (asked)
    bore.cut = hole.shape.cut;
  else
    make_at_catalogue_conditions(draft, item, bore, hole.shape.cut);
  if (part::is_reamed(bore)) bore.fit = fit;
  bore.left_mm = hole.shape.blank.left_mm;
  bore.right_mm = hole.shape.blank.right_mm;
  if (part::is_tapped(bore)) countersink_tapped(draft, item, i);
}

}  // namespace

void read_drilled_holes(Draft& draft) {
  auto& d = draft.drawing();
  if (!sizes_were_read(d) || d.inner.empty()) return;
  const auto items = draft.root.at("inner").as_items(0, d.inner.size());
  const bool bar = d.stock.inner_mm == 0;
  for (const auto end : {part::End::left, part::End::right}) {
    const auto bores = bores_of(d, end);
    auto holes = bar ? holes_of(draft, items, bores) : std::vector<MadeHole>{};
    if (!leave_the_others(d, bores, holes)) holes.clear();
    const std::size_t bored = bores.size() - holes.size();
    for (std::size_t k = 0; k < bores.size(); ++k) {
      const std::size_t i = bores[k];
      if (k >= bored)
        make(draft, items[i], i, holes[bores.size() - 1 - k]);
      else if (part::is_hole(d.inner[i]))
        items[i].problem_at(
            "kind",
            bar ? tr("a hole that is the innermost bore of its end, or is made by the "
                     "drill of the hole behind it or a flat drill, at least 1 mm "
                     "narrower than the bores before it")
                : tr("a bore: a tube is not drilled"),
            "conflict");
    }
  }
}

}  // namespace turnwright::document
