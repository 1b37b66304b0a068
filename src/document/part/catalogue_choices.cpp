#include <algorithm>

#include "base/say.hpp"
#include "document/catalogue/entries.hpp"
#include "part_sections.hpp"

namespace turnwright::document {
namespace {

template <class T>
void add_once(const Reader& item, std::vector<T>& list, T entry) {
  const bool twice = std::any_of(list.begin(), list.end(), [&](const auto& earlier) {
    return !entry.id.empty() && earlier.id == entry.id;
  });
  if (twice) item.problem(tr("each tool once"), "duplicate");
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

bool is_at_hand(const std::vector<std::string>& shops, const std::string& id) {
  return shops.empty() || std::find(shops.begin(), shops.end(), id) != shops.end();
}

// Those of the catalogue that the shop has; a shop that lists none has all.
template <class T>
std::vector<T> at_hand(const std::vector<T>& catalogue, const catalogue::Shop& shop) {
  std::vector<T> out;
  for (const auto& tool : catalogue)
    if (is_at_hand(shop.tools, tool.id)) out.push_back(tool);
  return out;
}

// For fixed operations for which no tool is listed those of `more` are used.
void complete(std::vector<catalogue::FixedTool>& tools,
              const std::vector<catalogue::FixedTool>& more) {
  const auto listed = tools;
  for (const auto& t : more)
    if (std::none_of(listed.begin(), listed.end(),
                     [&](const auto& l) { return l.use == t.use && l.inner == t.inner; }))
      tools.push_back(t);
}

// What is missing among the request's tools is taken from the shop's, then from the
// catalogue's.
void complete(Draft& draft, const catalogue::Shop& shop) {
  auto& plan = draft.plan();
  const auto& all = draft.catalogue;
  complete(plan.fixed_tools, at_hand(all.fixed_tools, shop));
  complete(plan.fixed_tools, all.fixed_tools);
  if (draft.cutters.empty()) draft.cutters = at_hand(all.cutters, shop);
  if (draft.cutters.empty()) draft.cutters = all.cutters;
}

void read_listed_tools(Draft& draft, const catalogue::Shop& shop) {
  auto& plan = draft.plan();
  for (const auto& item : draft.root.items("tools", 1, 200))
    if (is_fixed_tool(draft, item))
      add_once(item, plan.fixed_tools, fixed_tool_of(draft.catalogue, item));
    else if (is_cutter(draft, item))
      add_once(item, draft.cutters, cutter_of(draft.catalogue, item));
    else
      add_once(item, plan.tools, tool_of(draft.catalogue, item));
  for (const auto& spare : at_hand(draft.catalogue.tools, shop))
    if (std::none_of(plan.tools.begin(), plan.tools.end(),
                     [&](const auto& tool) { return tool.id == spare.id; }))
      plan.spare_tools.push_back(spare);
}

void read_tools(Draft& draft, const catalogue::Shop& shop) {
  auto& plan = draft.plan();
  const auto given = draft.root.find("tools");
  if (given && given->is_text()) {
    given->as_choice({"all"});
    plan.tools = draft.catalogue.tools;
    plan.fixed_tools = draft.catalogue.fixed_tools;
    draft.cutters = draft.catalogue.cutters;
  } else if (given) {
    read_listed_tools(draft, shop);
  } else {
    plan.tools = at_hand(draft.catalogue.tools, shop);
    const auto behind = std::stable_partition(
        plan.tools.begin(), plan.tools.end(),
        [](const auto& t) { return !catalogue::goes_behind_shoulders(t); });
    draft.undercut_tools.assign(behind, plan.tools.end());
    plan.tools.erase(behind, plan.tools.end());
    draft.assume(
        "/tools", ids(plan.tools),
        shop.tools.empty() ? tr("the whole catalogue") : say("the tools of {}", shop.id));
  }
  complete(draft, shop);
}

// The shop that the request names, or the usual one, if the catalogue has it.
catalogue::Shop read_the_shop(Draft& draft) {
  constexpr const char* kDefaultShop = "workshop";
  if (const auto given = draft.root.find("shop")) return shop_of(draft.catalogue, *given);
  for (const auto& shop : draft.catalogue.shops)
    if (shop.id == kDefaultShop) return shop;
  return {};
}

// The rules of the request are added to those of the shop; where both say how much proven
// conditions may cost, the request's number counts.
void read_shop_rules(Draft& draft, const catalogue::Shop& shop) {
  auto known = targets_of(draft.catalogue);
  auto& plan = draft.plan();
  for (const auto& more : {ids(plan.tools), ids(plan.fixed_tools)})
    known.tools.insert(known.tools.end(), more.begin(), more.end());
  std::erase_if(known.materials, [&](const auto& m) { return m.id == plan.material.id; });
  known.materials.push_back(plan.material);
  known.meant = plan.material.id;
  const auto add = [](auto& to, const auto& more) {
    to.insert(to.end(), more.begin(), more.end());
  };
  plan.rules = shop.rules;
  const auto own = read_rules(draft.root, known);
  add(plan.rules.forbidden_tools, own.forbidden_tools);
  add(plan.rules.speeds, own.speeds);
  double least = plan.machine.n_min_rpm;
  if (plan.machine.driven_tools && draft.root.has("milling"))
    least = std::max(least, plan.machine.driven_tools->n_min_rpm);
  for (const auto& most : {plan.rules.n_max_rpm, own.n_max_rpm})
    if (most && *most <= least)
      draft.root.problems().add({"/rules/n_max_rpm", number_text(*most),
                                 say("more than the {} 1/min at which {} begins",
                                     number_text(least), plan.machine.id),
                                 "conflict"});
  if (own.n_max_rpm)
    plan.rules.n_max_rpm =
        std::min(*own.n_max_rpm, plan.rules.n_max_rpm.value_or(*own.n_max_rpm));
  if (!own.proven.empty()) plan.rules.proven_within_pct = own.proven_within_pct;
  // The first entry of a tool and a material counts.
  plan.rules.proven.insert(plan.rules.proven.begin(), own.proven.begin(),
                           own.proven.end());
}

}  // namespace

void add_tools_for_undercuts(Draft& draft) {
  const auto goes_in = [](const std::optional<part::Undercut>& u) {
    return u && u->recess_mm > 0;
  };
  if (std::ranges::none_of(draft.drawing().outer, [&](const part::OuterElement& e) {
        return goes_in(e.left_undercut) || goes_in(e.right_undercut);
      }))
    return;
  auto& tools = draft.plan().tools;
  tools.insert(tools.end(), draft.undercut_tools.begin(), draft.undercut_tools.end());
  for (auto& a : draft.loaded.assumed)
    if (a.pointer == "/tools") a.value = ids(tools);
}

void read_catalogue_choices(Draft& draft) {
  constexpr const char* kDefaultMachine = "lathe-medium";
  auto& plan = draft.plan();
  const auto& catalogue = draft.catalogue;
  const auto material =
      draft.root.at("material", tr("the id of a material or its document"));
  plan.material = material_of(catalogue, material);
  if (material.is_text() && !plan.material.id.empty() &&
      material.json() != plan.material.id)
    draft.assume("/material", plan.material.id,
                 say("the catalogue has {} as {}", material.json().get<std::string>(),
                     plan.material.name));
  if (const auto machine = draft.root.find("machine")) {
    plan.machine = machine_of(catalogue, *machine);
  } else {
    draft.assume("/machine", kDefaultMachine, tr("no machine given"));
    const nlohmann::json id = kDefaultMachine;
    plan.machine = machine_of(catalogue, Reader(id, draft.root.problems(), "/machine"));
  }
  const auto shop = read_the_shop(draft);
  read_tools(draft, shop);
  read_shop_rules(draft, shop);
}

}  // namespace turnwright::document
