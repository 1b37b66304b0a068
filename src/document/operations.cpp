#include <algorithm>
#include <optional>

#include "fields.hpp"
#include "part_sections.hpp"

namespace turnwright::document {
namespace {

using planning::OperationKind;

// Kinds the schema knows; refuse_unsupported() tells which cannot be planned.
const Choices<std::optional<OperationKind>>& kinds() {
  static const auto kKinds = [] {
    Choices<std::optional<OperationKind>> out;
    for (const auto kind :
         {OperationKind::face, OperationKind::rough, OperationKind::finish})
      out.emplace_back(name(kind), kind);
    for (const auto* word : {"bore-rough", "bore-finish", "fixed"})
      out.emplace_back(word, std::nullopt);
    return out;
  }();
  return kKinds;
}

std::vector<std::string> surfaces(const part::Drawing& drawing, OperationKind kind) {
  if (features(drawing).empty()) return {};  // unreadable: nothing can be judged
  if (kind == OperationKind::face) return {"left", "right"};
  std::vector<std::string> out;
  for (const auto& e : drawing.outer) out.push_back(e.id);
  return out;
}

void read_on(Draft& draft, Reader& r, planning::OperationRequest& op) {
  const bool face = op.kind == OperationKind::face;
  const auto known = surfaces(draft.drawing(), op.kind);
  for (const auto& item : r.items("on", 1, face ? 1 : 100)) {
    auto id = checked_reference(item, known, face ? "an end face" : "an outer element");
    if (!id.empty() && std::find(op.on.begin(), op.on.end(), id) != op.on.end())
      item.problem("each element once", "duplicate");
    op.on.push_back(std::move(id));
  }
}

void read_tool_reference(Draft& draft, Reader& r, planning::OperationRequest& op) {
  if (!r.has("tool")) {
    if (draft.purpose == Purpose::predict)
      r.problem_at("tool", "the id of a tool", "missing");
    return;
  }
  std::vector<std::string> known;
  for (const auto& tool : draft.plan().tools) known.push_back(tool.id);
  op.tool = checked_reference(r.at("tool"), known, "a tool of this request");
}

void read_conditions(Draft& draft, Reader& r, planning::Conditions& c) {
  if (draft.purpose == Purpose::plan && !r.has("conditions")) return;
  Reader given = r.object("conditions");
  if (const auto passes = given.optional_integer("passes", 1, 100))
    c.passes = static_cast<int>(*passes);
  c.ap_mm = given.optional_number("ap_mm", above_up_to(0, 50, "mm"));
  c.f_mm_rev = given.optional_number("f_mm_rev", above_up_to(0, 5, "mm/rev"));
  c.vc_m_min = given.optional_number("vc_m_min", above_up_to(0, 5000, "m/min"));
  given.finish();
  if (draft.purpose == Purpose::plan || given.broken()) return;
  for (const auto* key : {"passes", "ap_mm", "f_mm_rev", "vc_m_min"})
    if (!given.has(key))
      given.problem_at(key, "a value: predict chooses none", "missing");
}

void read_direction(Draft& draft, Reader& r, planning::OperationRequest& op) {
  using enum planning::Direction;
  if (r.has("direction"))
    op.direction =
        r.choice<planning::Direction>("direction", named({to_chuck, from_chuck}));
  else
    draft.assume(r.pointer_of("direction"), name(op.direction), "usual direction");
}

planning::OperationRequest read_operation(Draft& draft, Reader r) {
  planning::OperationRequest op;
  r = r.as_object();
  op.id = read_id(r);
  const auto setups = static_cast<long>(draft.plan().setups.size());
  op.setup =
      static_cast<std::size_t>(r.integer("setup", 0, std::max(setups - 1, long{0})));
  const auto kind = r.choice<std::optional<OperationKind>>("kind", kinds());
  if (!kind) return op;
  op.kind = *kind;
  read_on(draft, r, op);
  read_tool_reference(draft, r, op);
  read_direction(draft, r, op);
  read_conditions(draft, r, op.conditions);
  r.finish();
  return op;
}

}  // namespace

void read_operations(Draft& draft) {
  const auto value = draft.root.find("operations");
  const bool automatic = !value || (value->is_text() && value->json() == "auto");
  if (automatic && draft.purpose == Purpose::predict) {
    draft.root.problem_at("operations", "a list of operations: predict chooses none",
                          "missing");
    return;
  }
  if (!value) draft.assume("/operations", "auto", "no operations given");
  if (automatic) return;
  if (!value->is_array()) {
    value->problem("\"auto\" or a list of operations", "type");
    return;
  }
  auto& operations = draft.plan().operations.emplace();
  for (const auto& item : value->as_items(1, 200)) {
    auto op = read_operation(draft, item);
    for (const auto& earlier : operations)
      if (!op.id.empty() && earlier.id == op.id)
        item.problem_at("id", "an id no other operation has", "duplicate");
    operations.push_back(std::move(op));
  }
}

}  // namespace turnwright::document
