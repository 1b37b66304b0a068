#include <algorithm>
#include <cmath>
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

// Whether an inner threading tool enters a thread's bore.
bool can_be_threaded(const Draft& draft, const part::InnerElement& thread) {
  const auto& plan = draft.loaded.plan;
  return std::ranges::any_of(plan.fixed_tools, [&](const FixedTool& t) {
    return t.use == FixedUse::threading && t.inner &&
           t.conditions_in(plan.material.group) && t.min_bore_mm <= thread.left_mm &&
           t.pitch_mm.lower <= thread.cut->pitch_mm &&
           thread.cut->pitch_mm <= t.pitch_mm.upper;
  });
}

// The tools for a use in the plan's material.
std::vector<const FixedTool*> tools_for(const Draft& draft, FixedUse use) {
  std::vector<const FixedTool*> all;
  const auto& plan = draft.loaded.plan;
  for (const auto& t : plan.fixed_tools)
    if (t.use == use && t.conditions_in(plan.material.group)) all.push_back(&t);
  return all;
}

// Those of which it is known what they leave of a hole.
std::vector<const FixedTool*> known_tools(const Draft& draft, FixedUse use) {
  auto all = tools_for(draft, use);
  std::erase_if(all, [](const FixedTool* t) { return !t->hole; });
  return all;
}

// A hole as tools on the axis make it.
struct Hole {
  part::Shaped shape;
  std::string how;  // for people
};

// A hole while it is looked at: what is asked of it, and the diameter of the drill that
// makes what lies behind it, if that is a hole too.
struct Wanted {
  double D_mm = 0, pitch_mm = 0;            // of a thread its nominal diameter
  double length_mm = 0, drilled_to_mm = 0;  // at least, from the face
  std::optional<part::Limits> limits = {};
  std::optional<double> Ra_um = {};
  std::optional<double> drill_mm = {};

  bool takes_drill(double size_mm) const { return !drill_mm || *drill_mm == size_mm; }
};

bool keeps(const FixedTool& tool, const Wanted& w) {
  return (!w.limits || keeps_size(tool, w.D_mm, *w.limits)) &&
         w.Ra_um.value_or(tool.hole->Ra_um) >= tool.hole->Ra_um;
}

// The drill's size between two limits, nearest to a third one, that goes deep enough.
std::optional<double> drill_between(const Draft& draft, const Wanted& w, double least_mm,
                                    double most_mm, double best_mm, double lead_mm) {
  constexpr double kRounding_mm = 1e-9;
  std::optional<double> found;
  for (const auto* t : tools_for(draft, FixedUse::drilling))
    for (const double size : t->sizes_mm) {
      const double deep = w.drilled_to_mm + lead_mm;
      if (size < least_mm - kRounding_mm || size > most_mm + kRounding_mm ||
          !w.takes_drill(size) || deep > t->reach * size)
        continue;
      if (!found || std::abs(size - best_mm) < std::abs(*found - best_mm)) found = size;
    }
  return found;
}

std::optional<Hole> drilled_hole(const Draft& draft, const Wanted& w) {
  for (const auto* t : known_tools(draft, FixedUse::drilling))
    if (has_size(*t, w.D_mm) && w.takes_drill(w.D_mm) && keeps(*t, w) &&
        w.drilled_to_mm <= t->reach * w.D_mm)
      return Hole{part::hole(w.D_mm),
                  "drilled to its size by " + t->id + ", to " + promise(*t)};
  return std::nullopt;
}

std::optional<Hole> reamed_hole(const Draft& draft, const Wanted& w) {
  for (const auto* t : known_tools(draft, FixedUse::reaming)) {
    if (!has_size(*t, w.D_mm) || !keeps(*t, w) ||
        w.length_mm + t->lead > t->reach * w.D_mm)
      continue;
    const double least = w.D_mm - t->allowance_mm.upper,
                 most = w.D_mm - t->allowance_mm.lower;
    if (const auto drill = drill_between(draft, w, least, most, most, t->lead))
      return Hole{part::reamed(w.D_mm, *drill, t->lead),
                  "drilled to " + number_text(*drill) + " mm and reamed by " + t->id +
                      ", to " + promise(*t)};
  }
  return std::nullopt;
}

std::optional<Hole> tapped_hole(const Draft& draft, const Wanted& w) {
  const auto D1 = part::minor_diameter_6H(w.D_mm, w.pitch_mm);
  for (const auto* t : tools_for(draft, FixedUse::tapping)) {
    const double lead = t->lead * w.pitch_mm;
    if (!catalogue::thread_of(*t, w.D_mm, w.pitch_mm) ||
        w.length_mm + lead > t->reach * w.D_mm)
      continue;
    if (const auto drill =
            drill_between(draft, w, D1.least_mm, D1.most_mm, w.D_mm - w.pitch_mm, lead))
      return Hole{part::tapped(w.D_mm, w.pitch_mm, *drill, lead),
                  "drilled to " + number_text(*drill) + " mm and tapped by " + t->id};
  }
  return std::nullopt;
}

bool is_thread(const part::InnerElement& e) {
  return e.cut && e.cut->kind == part::CutKind::thread;
}

// The countersink of the material for a chamfer up to a diameter where a bore begins, of an
// angle if that is given; none.
const FixedTool* countersink_for(const Draft& draft, std::size_t i, double D_mm,
                                 const part::Chamfer* chamfer) {
  constexpr double kBeside_mm = 0.2;  // as planning asks in the bores before the hole
  const double room = part::way_in_mm(draft.loaded.plan.drawing, i) - 2 * kBeside_mm;
  for (const auto* t : tools_for(draft, FixedUse::countersinking)) {
    const auto size = std::ranges::lower_bound(t->sizes_mm, D_mm);
    if (size != t->sizes_mm.end() && *size <= room &&
        (!chamfer || part::fits_countersink(*chamfer, t->point_deg)))
      return t;
  }
  return nullptr;
}

// Whether a countersink cuts the chamfer where a bore begins, if it has one.
bool can_be_countersunk(const Draft& draft, std::size_t i) {
  const auto& e = draft.loaded.plan.drawing.inner[i];
  const auto& c = part::opening_chamfer(e);
  return !c || countersink_for(draft, i, e.left_mm + 2 * c->radial_mm, &*c);
}

// Without other edges than that chamfer.
bool plain(const Draft& draft, std::size_t i) {
  const auto& e = draft.loaded.plan.drawing.inner[i];
  const auto& inside = e.from == part::End::left ? e.right_chamfer : e.left_chamfer;
  return e.kind == part::ElementKind::cylinder && !inside && !e.left_fillet_mm &&
         !e.right_fillet_mm && can_be_countersunk(draft, i);
}

// Indices of the bores of an end of a bar, outermost first.
using Bores = std::vector<std::size_t>;
Bores bores_of(const part::Drawing& d, part::End end) {
  Bores bores;
  for (std::size_t i = 0; i < d.inner.size(); ++i)
    if (d.inner[i].from == end) bores.push_back(i);
  return bores;
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

// What the drill of the k-th bore of an end has to do; `behind` is the hole that it goes on
// to make.
Wanted wanted(const part::Drawing& d, const Bores& bores, std::size_t k,
              const std::optional<Hole>& behind) {
  Wanted w;
  const auto& e = d.inner[bores[k]];
  w.D_mm = is_thread(e) ? e.cut->drawn.left_mm : e.left_mm;
  w.length_mm = e.length_mm;
  if (e.cut) w.pitch_mm = e.cut->pitch_mm;
  for (std::size_t i = 0; i <= k; ++i) w.drilled_to_mm += d.inner[bores[i]].length_mm;
  if (behind) w.drill_mm = behind->shape.cut.drilled_mm;
  return w;
}

// Refuses what is asked of a hole and no drill or reamer of its diameter leaves.
void refuse_demands(const Draft& draft, Reader hole, const Wanted& w) {
  auto tools = known_tools(draft, FixedUse::drilling);
  for (const auto* t : known_tools(draft, FixedUse::reaming)) tools.push_back(t);
  std::erase_if(tools, [&](const auto* t) { return !has_size(*t, w.D_mm); });
  if (tools.empty()) return;
  const auto refuse = [&](const char* key) {
    std::string made;
    for (const auto* t : tools)
      made += (made.empty() ? "" : "; ") + t->id + " " + promise(*t);
    hole.problem_at(key,
                    "no more than a drill or a reamer leaves (" + made +
                        "), or \"cylinder\" as kind, which is bored",
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
std::optional<Hole> asked_hole(const Draft& draft, Reader item, std::size_t i, Wanted w) {
  if (!plain(draft, i))
    item.problem_at(
        "kind",
        "\"cylinder\" as kind, which is bored, or no other edge than a chamfer "
        "where the hole begins, of the angle of a countersink of the tools",
        "conflict");
  w.limits = given_limits(item, w.D_mm);
  w.Ra_um = item.optional_number("Ra_um", above_up_to(0, 100, "um"));
  if (w.limits || w.Ra_um) {
    if (drilled_hole(draft, w)) return Hole{part::hole(w.D_mm), ""};
    if (auto reamed = reamed_hole(draft, w)) return reamed;
    refuse_demands(draft, item, w);
  }
  if (!w.takes_drill(w.D_mm)) return std::nullopt;
  return Hole{part::hole(w.D_mm), ""};
}

// Whether the operations are the planner's, or one of them drills a bore and none bores it.
bool drilled_by_operations(const Draft& draft, const std::string& id) {
  const auto given = draft.root.find("operations");
  if (!given || !given->is_array()) return true;
  bool fixed = false;
  for (const auto& o : given->json()) {
    if (!o.is_object() || !names(o.value("on", nlohmann::json()), id)) continue;
    if (o.value("kind", nlohmann::json()) != "fixed") return false;
    fixed = true;
  }
  return fixed;
}

// A bore that is too narrow to be bored as drill, reamer or tap make it, if they leave it
// as it is drawn.
std::optional<Hole> narrow_hole(const Draft& draft, std::size_t i, Wanted w) {
  const auto& bore = draft.loaded.plan.drawing.inner[i];
  const bool thread = is_thread(bore);
  const auto named = draft.root.find("tolerances");
  if (!plain(draft, i) || (bore.cut && !thread) || bore.Rz_um ||
      !drilled_by_operations(draft, bore.id) ||
      (named && names(named->json(), bore.id)) ||
      (can_be_bored(draft.loaded.plan.tools, bore.left_mm) &&
       (!thread || can_be_threaded(draft, bore))))
    return std::nullopt;
  if (thread) return tapped_hole(draft, w);
  w.limits = limits_of(bore);
  w.Ra_um = bore.Ra_um;
  auto hole = drilled_hole(draft, w);
  return hole ? hole : reamed_hole(draft, w);
}

// The holes of an end of a bar, innermost first: one drill makes them all.
std::vector<Hole> holes_of(const Draft& draft, const std::vector<Reader>& items,
                           const Bores& bores) {
  const auto& d = draft.loaded.plan.drawing;
  std::vector<Hole> holes;
  std::optional<Hole> behind;
  for (std::size_t k = bores.size(); k-- > 0;) {
    const std::size_t i = bores[k];
    const auto w = wanted(d, bores, k, behind);
    behind = part::is_hole(d.inner[i]) ? asked_hole(draft, items[i], i, w)
                                       : narrow_hole(draft, i, w);
    if (!behind) break;
    holes.push_back(*behind);
  }
  return holes;
}

// Whether boring still cuts the bores before the holes, and their tools pass through them.
bool leave_the_others(const part::Drawing& d, const Bores& bores,
                      const std::vector<Hole>& holes) {
  double least_mm = 0;
  for (const auto& hole : holes)
    least_mm =
        std::max({least_mm, hole.shape.cut.drilled_mm + 2 * planning::kLeftToBore_mm,
                  hole.shape.cut.drawn.left_mm});
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
  const auto* t = countersink_for(draft, i, D, nullptr);
  if (part::opening_chamfer(bore) || !t || D + 2 * kRing_mm > end_mm) return;
  const double radial = (D - bore.cut->drilled_mm) / 2;
  const double axial = radial / std::tan(units::rad_from_deg(t->point_deg / 2));
  if (!(axial < bore.length_mm)) return;
  (left ? bore.left_chamfer : bore.right_chamfer) = part::Chamfer{axial, radial};
  draft.assume(item.pointer_of("kind"), {{"countersunk_to_mm", D}},
               "1.05 times the thread's diameter (DIN 76-1), by " + t->id);
}

void make(Draft& draft, const Reader& item, std::size_t i, const Hole& hole) {
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
  const bool bar = d.stock.kind == part::StockKind::bar;
  for (const auto end : {part::End::left, part::End::right}) {
    const auto bores = bores_of(d, end);
    auto holes = bar ? holes_of(draft, items, bores) : std::vector<Hole>{};
    if (!leave_the_others(d, bores, holes)) holes.clear();
    const std::size_t bored = bores.size() - holes.size();
    for (std::size_t k = 0; k < bores.size(); ++k) {
      const std::size_t i = bores[k];
      if (k >= bored)
        make(draft, items[i], i, holes[bores.size() - 1 - k]);
      else if (part::is_hole(d.inner[i]))
        items[i].problem_at(
            "kind",
            bar ? "a hole that is the innermost bore of its end, or is "
                  "made by the drill of the hole behind it, at least 1 mm "
                  "narrower than the bores before it"
                : "a bore: a tube is not drilled",
            "conflict");
    }
  }
}

}  // namespace turnwright::document
