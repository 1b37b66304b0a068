#include <algorithm>
#include <optional>

#include "base/say.hpp"
#include "document/json/fields.hpp"
#include "document/json/reference.hpp"
#include "part_sections.hpp"

namespace turnwright::document {
namespace {

using planning::OperationKind;

const Choices<OperationKind>& kinds() {
  static const auto kKinds = named({OperationKind::face, OperationKind::rough,
                                    OperationKind::finish, OperationKind::bore_rough,
                                    OperationKind::bore_finish, OperationKind::fixed});
  return kKinds;
}

bool is_boring(OperationKind kind) {
  return kind == OperationKind::bore_rough || kind == OperationKind::bore_finish;
}

template <class Element>
bool chamfered(const Element& e) {
  return e.left_chamfer || e.right_chamfer;
}

// Whether a boring bar cuts what an operation is on.
bool is_by_bar(const part::Drawing& drawing, const planning::OperationRequest& op) {
  return is_boring(op.kind) || (op.kind == OperationKind::face && !op.on.empty() &&
                                part::inner_shoulder(drawing, op.on.front()).has_value());
}

// Targets of fixed operations: grooves, threads and arcs; drilled bores; chamfers with a
// pass of their own; ends that are centred or parted off.
std::vector<std::string> fixed_surfaces(const part::Drawing& drawing) {
  std::vector<std::string> out;
  for (const auto& e : drawing.outer)
    if (e.cut || chamfered(e)) out.push_back(e.id);
  for (const auto& e : drawing.inner)
    if (e.cut || chamfered(e) || drawing.stock.inner_mm == 0) out.push_back(e.id);
  out.insert(out.end(), {"left", "right"});
  return out;
}

std::vector<std::string> surfaces(const part::Drawing& drawing, OperationKind kind) {
  if (features(drawing).empty()) return {};  // unreadable, so that nothing can be checked
  if (kind == OperationKind::fixed) return fixed_surfaces(drawing);
  std::vector<std::string> out;
  if (kind == OperationKind::face)
    for (const auto& named : features(drawing))
      if (is_face(named.feature)) out.push_back(named.id);
  if (kind == OperationKind::face) return out;
  if (is_boring(kind))
    for (const auto& e : drawing.inner) out.push_back(e.id);
  else
    for (const auto& e : drawing.outer)
      if (!e.as_stock) out.push_back(e.id);
  return out;
}

std::string wanted(OperationKind kind) {
  if (kind == OperationKind::face) return tr("a face");
  if (kind == OperationKind::fixed)
    return tr("a groove, thread or arc, a bore of a bar, or an end");
  return is_boring(kind) ? tr("an inner element") : tr("an outer element");
}

// A boring bar faces shoulders between bores, where a tolerance is on them.
void check_shoulder(const Draft& draft, const Reader& item,
                    const planning::OperationRequest& op, const std::string& id) {
  const auto& d = draft.loaded.plan.drawing;
  const bool inside = part::inner_shoulder(d, id).has_value();
  if (!op.on.empty() && inside != is_by_bar(d, op))
    item.problem(tr("shoulders between bores, which a boring bar faces, in an operation "
                    "of their own"),
                 "conflict");
  if (inside && !part::has_tolerance(d, id))
    item.problem(tr("a shoulder that a tolerance is on: others between bores are made "
                    "with the wider one"),
                 "conflict");
}

void read_on(Draft& draft, Reader& r, planning::OperationRequest& op) {
  const auto known = surfaces(draft.drawing(), op.kind);
  for (const auto& item : r.items("on", 1, 100)) {
    auto id = checked_wall(item, draft.drawing(),
                           checked_reference(item, known, wanted(op.kind)));
    if (op.kind == OperationKind::face) check_shoulder(draft, item, op, id);
    if (!id.empty() && std::find(op.on.begin(), op.on.end(), id) != op.on.end())
      item.problem(tr("each element once"), "duplicate");
    op.on.push_back(std::move(id));
  }
}

void read_tool_reference(Draft& draft, Reader& r, planning::OperationRequest& op) {
  if (!r.has("tool")) {
    if (draft.purpose == Purpose::predict && op.kind != OperationKind::fixed)
      r.problem_at("tool", tr("the id of a tool"), "missing");
    return;
  }
  std::vector<std::string> known;
  if (op.kind == OperationKind::fixed) {
    for (const auto& tool : draft.plan().fixed_tools) known.push_back(tool.id);
    op.tool = checked_reference(r.at("tool"), known, tr("a tool for fixed operations"));
    return;
  }
  for (const auto& tool : draft.plan().tools) known.push_back(tool.id);
  op.tool = checked_reference(r.at("tool"), known, tr("a tool of this request"));
  const bool by_bar = is_by_bar(draft.drawing(), op);
  for (const auto& tool : draft.plan().tools)
    if (tool.id == *op.tool && tool.bar.has_value() != by_bar)
      r.problem_at("tool",
                   by_bar ? tr("a tool with a boring bar")
                          : tr("a tool for the outside, not a boring bar"),
                   "conflict");
}

// Fixed operations take conditions that are left out from their tool.
void read_conditions(Draft& draft, Reader& r, OperationKind kind,
                     planning::Conditions& c) {
  const bool whole = draft.purpose == Purpose::predict && kind != OperationKind::fixed;
  if (!whole && !r.has("conditions")) return;
  Reader given = r.object("conditions");
  if (const auto passes = given.optional_integer("passes", 1, 100))
    c.passes = static_cast<int>(*passes);
  c.ap_mm = given.optional_number("ap_mm", above_up_to(0, 50, "mm"));
  c.f_mm_rev = given.optional_number("f_mm_rev", above_up_to(0, 5, "mm/rev"));
  c.vc_m_min = given.optional_number("vc_m_min", above_up_to(0, 5000, "m/min"));
  given.finish();
  if (!whole || given.broken()) return;
  for (const auto* key : {"passes", "ap_mm", "f_mm_rev", "vc_m_min"})
    if (!given.has(key))
      given.problem_at(key, tr("a value: predict chooses none"), "missing");
}

void read_direction(Draft& draft, Reader& r, planning::OperationRequest& op) {
  using enum planning::Direction;
  if (r.has("direction"))
    op.direction =
        r.choice<planning::Direction>("direction", named({to_chuck, from_chuck}));
  else
    draft.assume(r.pointer_of("direction"), name(op.direction), tr("usual direction"));
}

planning::OperationRequest read_operation(Draft& draft, Reader r) {
  planning::OperationRequest op;
  r = r.as_object();
  op.id = read_id(r);
  const auto setups = static_cast<long>(draft.plan().setups.size());
  op.setup =
      static_cast<std::size_t>(r.integer("setup", 0, std::max(setups - 1, long{0})));
  const auto before = r.problems().list.size();
  op.kind = r.choice("kind", kinds());
  if (r.problems().list.size() > before) return op;  // the other keys depend on it
  if (is_boring(op.kind) && draft.drawing().inner.empty()) {
    r.problem_at("kind", tr("an operation on the outside: the part has no bores"),
                 "conflict");
    return op;
  }
  read_on(draft, r, op);
  read_tool_reference(draft, r, op);
  read_direction(draft, r, op);
  read_conditions(draft, r, op.kind, op.conditions);
  r.finish();
  return op;
}

bool is_end(const std::string& surface) {
  return surface == "left" || surface == "right";
}

// What the fixed tool that an operation names is for; nothing without one.
std::optional<catalogue::FixedUse> use_of(const Draft& draft,
                                          const planning::OperationRequest& op) {
  const auto& tools = draft.loaded.plan.fixed_tools;
  if (op.kind != OperationKind::fixed || !op.tool) return std::nullopt;
  const auto it = std::ranges::find(tools, *op.tool, &catalogue::FixedTool::id);
  return it == tools.end() ? std::nullopt : std::optional(it->use);
}

// Whether they are two of the tools that make a bore, one after the other.
bool differ_in_a_bore(const Draft& draft, const planning::OperationRequest& earlier,
                      const planning::OperationRequest& op, const std::string& on) {
  const auto a = use_of(draft, earlier), b = use_of(draft, op);
  const auto& inner = draft.loaded.plan.drawing.inner;
  return a && b && *a != *b && earlier.setup == op.setup &&
         std::ranges::find(inner, on, &part::InnerElement::id) != inner.end();
}

// An element is made in one setup, by one roughing, one finishing and one fixed operation
// at most; an end may be faced in one setup and centred or parted off in another, and an
// element get its chamfer there.  A bore has as many fixed operations as tools make it.
void check_pair(Reader r, const Draft& draft, const planning::OperationRequest& earlier,
                const planning::OperationRequest& op) {
  const auto shared = std::find_first_of(op.on.begin(), op.on.end(), earlier.on.begin(),
                                         earlier.on.end());
  if (shared == op.on.end() || shared->empty() ||
      differ_in_a_bore(draft, earlier, op, *shared))
    return;
  const auto& drawing = draft.loaded.plan.drawing;
  const auto has_chamfer = [&](const auto& e) { return e.id == *shared && chamfered(e); };
  const bool twice = is_end(*shared) || std::ranges::any_of(drawing.outer, has_chamfer) ||
                     std::ranges::any_of(drawing.inner, has_chamfer);
  if (twice &&
      (earlier.kind == OperationKind::fixed || op.kind == OperationKind::fixed)) {
    if (earlier.kind != op.kind || earlier.setup != op.setup) return;
  }
  if (earlier.kind == op.kind)
    r.problem_at("on",
                 say("elements that {}, also \"{}\", does not cut: not {}", earlier.id,
                     name(op.kind), *shared),
                 "duplicate");
  else if (earlier.setup != op.setup)
    r.problem_at("setup", say("the setup of {}, which cuts {} too", earlier.id, *shared),
                 "conflict");
}

// Whether a fixed tool is one of those that make a hole.
bool makes_hole(catalogue::FixedUse use, const part::InnerElement& hole) {
  using enum catalogue::FixedUse;
  return use == drilling || (use == countersinking && part::opening_chamfer(hole)) ||
         (use == tapping && part::is_tapped(hole)) ||
         (use == reaming && part::is_reamed(hole)) ||
         (use == counterboring && part::is_counterbore(hole));
}

// The tools that make a hole.
std::string makers(const part::InnerElement& hole) {
  std::string all = part::is_tapped(hole)        ? tr("a drill or a tap")
                    : part::is_reamed(hole)      ? tr("a drill or a reamer")
                    : part::is_counterbore(hole) ? tr("a drill or a flat drill")
                                                 : tr("a drill");
  if (part::opening_chamfer(hole)) all += tr(", or a countersink");
  return all;
}

// A hole is not made by other tools than those that follow from its drawing.
void check_hole_tool(const Draft& draft, Reader r, const planning::OperationRequest& op,
                     const std::string& id) {
  const auto& inner = draft.loaded.plan.drawing.inner;
  const auto hole = std::ranges::find(inner, id, &part::InnerElement::id);
  const auto use = use_of(draft, op);
  if (hole == inner.end() || !part::is_hole(*hole) || !use || makes_hole(*use, *hole))
    return;
  r.problem_at("tool", say("{}: they make {}", makers(*hole), id), "conflict");
}

// The held end may be parted off, if the stock is; the free end may get a centre hole.
// Drilling, centring and parting off have one pass.
void check_fixed(Draft& draft, Reader r, const planning::OperationRequest& op) {
  if (op.kind != OperationKind::fixed || !(op.setup < draft.plan().setups.size())) return;
  const auto& drawing = draft.drawing();
  const bool left = draft.plan().setups[op.setup].hold == part::End::left;
  const auto known = fixed_surfaces(drawing);
  for (const auto& id : op.on) {
    if (std::find(known.begin(), known.end(), id) == known.end()) continue;  // reported
    check_hole_tool(draft, r, op, id);
    if (id == (left ? "left" : "right") && !(op.setup == 0 && drawing.stock.parted_mm))
      r.problem_at("on",
                   tr("the free end; the held one is parted off in the first setup if "
                      "/stock/part_off_allowance_mm says what that leaves"),
                   "conflict");
    const auto has_cut = [&](const auto& e) { return e.id == id && e.cut; };
    if (op.conditions.passes.value_or(1) > 1 &&
        std::none_of(drawing.outer.begin(), drawing.outer.end(), has_cut) &&
        std::none_of(drawing.inner.begin(), drawing.inner.end(), has_cut))
      r.problem_at("conditions",
                   say("one pass: {} is drilled, centred or parted off in one", id),
                   "conflict");
  }
}

// A groove without a turning operation of its own is turned with the element whose
// diameter its blank has.
template <class Element>
void turn_grooves(Draft& draft, const std::vector<Element>& list) {
  auto& operations = *draft.plan().operations;
  const auto turns = [](const planning::OperationRequest& o, const std::string& id) {
    return o.kind != OperationKind::fixed &&
           std::find(o.on.begin(), o.on.end(), id) != o.on.end();
  };
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto& id = list[i].id;
    if (!part::is_groove(list[i])) continue;
    if (std::any_of(operations.begin(), operations.end(),
                    [&](const auto& o) { return turns(o, id); }))
      continue;
    const auto k = beside(list, i);
    if (!k) continue;  // reported already
    const auto given = operations;
    for (auto o : given) {
      if (!turns(o, list[*k].id)) continue;
      o.id += ":" + id;
      o.on = {id};
      draft.assume("/operations", {{"id", o.id}, {"kind", name(o.kind)}, {"on", o.on}},
                   say("a groove's blank is turned like {} beside it", list[*k].id));
      operations.push_back(std::move(o));
    }
  }
}

}  // namespace

void read_operations(Draft& draft) {
  const auto value = draft.root.find("operations");
  const bool automatic = !value || (value->is_text() && value->json() == "auto");
  if (automatic && draft.purpose == Purpose::predict) {
    draft.root.problem_at("operations", tr("a list of operations: predict chooses none"),
                          "missing");
    return;
  }
  if (!value) draft.assume("/operations", "auto", tr("no operations given"));
  if (automatic) return;
  if (!value->is_array()) {
    value->problem(tr("\"auto\" or a list of operations"), "type");
    return;
  }
  auto& operations = draft.plan().operations.emplace();
  for (const auto& item : value->as_items(1, 200)) {
    auto op = read_operation(draft, item);
    for (const auto& earlier : operations) {
      if (!op.id.empty() && earlier.id == op.id)
        item.problem_at("id", tr("an id no other operation has"), "duplicate");
      check_pair(item, draft, earlier, op);
    }
    check_fixed(draft, item, op);
    operations.push_back(std::move(op));
  }
  turn_grooves(draft, draft.drawing().outer);
  turn_grooves(draft, draft.drawing().inner);
}

}  // namespace turnwright::document
