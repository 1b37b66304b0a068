#include <algorithm>

#include "document/catalogue/entries.hpp"
#include "part_sections.hpp"

namespace turnwright::document {
namespace {

template <class T>
void add_once(const Reader& item, std::vector<T>& list, T entry) {
  const bool twice = std::any_of(list.begin(), list.end(), [&](const auto& earlier) {
    return !entry.id.empty() && earlier.id == entry.id;
  });
  if (twice) item.problem("each tool once", "duplicate");
  list.push_back(std::move(entry));
}

// An id of tools/fixed, or a document of that format.
bool is_fixed_tool(const Draft& draft, const Reader& item) {
  if (item.is_object())
    return item.json().value("format", nlohmann::json()) == "turnwright-fixed-tool/1";
  const auto& fixed = draft.catalogue.fixed_tools;
  return item.is_text() && std::any_of(fixed.begin(), fixed.end(), [&](const auto& t) {
           return item.json() == t.id;
         });
}

// An id of tools/milling, or a document of that format.
bool is_cutter(const Draft& draft, const Reader& item) {
  if (item.is_object())
    return item.json().value("format", nlohmann::json()) == "turnwright-milling-cutter/1";
  const auto& cutters = draft.catalogue.cutters;
  return item.is_text() &&
         std::any_of(cutters.begin(), cutters.end(),
                     [&](const auto& c) { return item.json() == c.id; });
}

// For fixed operations for which the request lists no tool those of the catalogue are
// used.
void add_fixed_tools_of_the_catalogue(Draft& draft) {
  auto& tools = draft.plan().fixed_tools;
  const auto listed = tools;
  for (const auto& t : draft.catalogue.fixed_tools)
    if (std::none_of(listed.begin(), listed.end(),
                     [&](const auto& l) { return l.use == t.use && l.inner == t.inner; }))
      tools.push_back(t);
}

void read_tools(Draft& draft) {
  auto& plan = draft.plan();
  if (!draft.root.has("tools")) {
    plan.tools = draft.catalogue.tools;
    plan.fixed_tools = draft.catalogue.fixed_tools;
    draft.cutters = draft.catalogue.cutters;
    draft.assume("/tools", ids(plan.tools), "the whole catalogue");
    return;
  }
  for (const auto& item : draft.root.items("tools", 1, 200))
    if (is_fixed_tool(draft, item))
      add_once(item, plan.fixed_tools, fixed_tool_of(draft.catalogue, item));
    else if (is_cutter(draft, item))
      add_once(item, draft.cutters, cutter_of(draft.catalogue, item));
    else
      add_once(item, plan.tools, tool_of(draft.catalogue, item));
  add_fixed_tools_of_the_catalogue(draft);
  if (draft.cutters.empty()) draft.cutters = draft.catalogue.cutters;
  for (const auto& spare : draft.catalogue.tools)
    if (std::none_of(plan.tools.begin(), plan.tools.end(),
                     [&](const auto& tool) { return tool.id == spare.id; }))
      plan.spare_tools.push_back(spare);
}

}  // namespace

void read_catalogue_choices(Draft& draft) {
  constexpr const char* kDefaultMachine = "lathe-medium";
  auto& plan = draft.plan();
  const auto& catalogue = draft.catalogue;
  const auto material = draft.root.at("material", "the id of a material or its document");
  plan.material = material_of(catalogue, material);
  if (material.is_text() && !plan.material.id.empty() &&
      material.json() != plan.material.id)
    draft.assume("/material", plan.material.id,
                 "the catalogue has " + material.json().get<std::string>() + " as " +
                     plan.material.name);
  if (const auto machine = draft.root.find("machine")) {
    plan.machine = machine_of(catalogue, *machine);
  } else {
    draft.assume("/machine", kDefaultMachine, "no machine given");
    const nlohmann::json id = kDefaultMachine;
    plan.machine = machine_of(catalogue, Reader(id, draft.root.problems(), "/machine"));
  }
  read_tools(draft);
}

}  // namespace turnwright::document
