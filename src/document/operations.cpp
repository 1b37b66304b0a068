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
         {OperationKind::face, OperationKind::rough, OperationKind::finish,
          OperationKind::bore_rough, OperationKind::bore_finish})
      out.emplace_back(name(kind), kind);
    out.emplace_back("fixed", std::nullopt);
    return out;
  }();
  return kKinds;
}

bool is_boring(OperationKind kind) {
  return kind == OperationKind::bore_rough || kind == OperationKind::bore_finish;
}

std::vector<std::string> surfaces(const part::Drawing& drawing, OperationKind kind) {
  if (features(drawing).empty()) return {};  // unreadable: nothing can be judged
  std::vector<std::string> out;
  if (kind == OperationKind::face)
    for (const auto& named : features(drawing))
      if (named.feature == Feature::face) out.push_back(named.id);
  if (kind == OperationKind::face) return out;
  if (is_boring(kind))
    for (const auto& e : drawing.inner) out.push_back(e.id);
  else
    for (const auto& e : drawing.outer) out.push_back(e.id);
  return out;
}

const char* wanted(OperationKind kind) {
  if (kind == OperationKind::face) return "a face";
  return is_boring(kind) ? "an inner element" : "an outer element";
}

void read_on(Draft& draft, Reader& r, planning::OperationRequest& op) {
  const auto known = surfaces(draft.drawing(), op.kind);
  for (const auto& item : r.items("on", 1, 100)) {
    auto id = checked_reference(item, known, wanted(op.kind));
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
  for (const auto& tool : draft.plan().tools)
    if (tool.id == *op.tool && tool.bar.has_value() != is_boring(op.kind))
      r.problem_at("tool",
                   is_boring(op.kind) ? "a tool with a boring bar"
                                      : "a tool for the outside, not a boring bar",
                   "conflict");
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
  if (is_boring(op.kind) && draft.drawing().inner.empty()) {
    r.problem_at("kind", "an operation on the outside: the part has no bores",
                 "conflict");
    return op;
  }
  read_on(draft, r, op);
  read_tool_reference(draft, r, op);
  read_direction(draft, r, op);
  read_conditions(draft, r, op.conditions);
  r.finish();
  return op;
}

// An element is made in one setup, by one roughing and one finishing operation at most.
void check_pair(Reader r, const planning::OperationRequest& earlier,
                const planning::OperationRequest& op) {
  const auto shared = std::find_first_of(op.on.begin(), op.on.end(), earlier.on.begin(),
                                         earlier.on.end());
  if (shared == op.on.end() || shared->empty()) return;
  if (earlier.kind == op.kind)
    r.problem_at("on",
                 "elements that " + earlier.id + ", also \"" + name(op.kind) +
                     "\", does not cut: not " + *shared,
                 "duplicate");
  else if (earlier.setup != op.setup)
    r.problem_at("setup",
                 "the setup of " + earlier.id + ", which cuts " + *shared + " too",
                 "conflict");
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
    for (const auto& earlier : operations) {
      if (!op.id.empty() && earlier.id == op.id)
        item.problem_at("id", "an id no other operation has", "duplicate");
      check_pair(item, earlier, op);
    }
    operations.push_back(std::move(op));
  }
}

}  // namespace turnwright::document
