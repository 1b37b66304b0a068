#include "shop.hpp"

#include <algorithm>

#include "document/json/fields.hpp"
#include "document/json/reference.hpp"
#include "material_names.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::document {
namespace {

using catalogue::HouseSpeed;
using catalogue::ProvenConditions;
using catalogue::ShopRules;

constexpr std::size_t kRules = 20, kProven = 500;
const Bounds kSpeeds = above_up_to(0, 5000, "m/min");

std::vector<std::string> read_tool_ids(Reader& r, std::string_view key, std::size_t most,
                                       const ShopTargets& known) {
  std::vector<std::string> all;
  for (const auto& item : r.optional_items(key, 0, most)) {
    auto id = checked_reference(item, known.tools,
                                tr("a tool of the catalogue or the request"));
    if (std::ranges::find(all, id) != all.end())
      item.problem(tr("each tool once"), "duplicate");
    all.push_back(std::move(id));
  }
  return all;
}

std::string read_tool_id(const Reader& value, const ShopTargets& known) {
  return checked_reference(value, known.tools,
                           tr("a tool of the catalogue or the request"));
}

// The id of the material that is called so.
std::string read_material_id(const Reader& value, const ShopTargets& known) {
  const auto name = value.as_text();
  const auto called = materials_called(name, known.materials);
  if (called.size() == 1) return called.front().id;
  if (std::ranges::any_of(called, [&](const auto& m) { return m.id == known.meant; }))
    return known.meant;
  std::vector<std::string> ids;
  for (const auto& m : known.materials) ids.push_back(m.id);
  if (called.size() > 1)
    value.problem(expected_state(called), "ambiguous");
  else if (!name.empty())
    value.problem(
        expected_reference(name, ids, tr("a material of the catalogue or the request")),
        "unknown-id");
  return {};
}

HouseSpeed read_speed(Reader r, const ShopTargets& known) {
  r = r.as_object();
  HouseSpeed s{.vc_m_min = read_range(r, "vc_m_min", kSpeeds)};
  if (const auto tool = r.find("tool")) s.tool = read_tool_id(*tool, known);
  if (const auto material = r.find("material"))
    s.material = read_material_id(*material, known);
  s.group = r.optional_choice("group", iso_groups());
  r.finish();
  return s;
}

ProvenConditions read_proven(Reader r, const ShopTargets& known) {
  r = r.as_object();
  ProvenConditions p;
  p.tool = read_tool_id(r.at("tool", tr("the id of a tool")), known);
  p.material = read_material_id(r.at("material", tr("a material")), known);
  const auto range = [&](const char* key, const Bounds& bounds) {
    return r.has(key) ? std::optional(read_range(r, key, bounds)) : std::nullopt;
  };
  p.vc_m_min = range("vc_m_min", kSpeeds);
  p.f_mm_rev = range("f_mm_rev", above_up_to(0, 5, "mm/rev"));
  p.ap_mm = range("ap_mm", above_up_to(0, 50, "mm"));
  r.finish();
  return p;
}

void read_all_proven(Reader r, const ShopTargets& known, ShopRules& rules) {
  rules.proven_within_pct = r.number_or("within_pct", within(0, 100, "%"), 5);
  for (const auto& item : r.items("conditions", 1, kProven)) {
    auto p = read_proven(item, known);
    const auto same = [&](const auto& other) {
      return !p.tool.empty() && other.tool == p.tool && other.material == p.material;
    };
    if (std::ranges::any_of(rules.proven, same))
      item.problem(tr("each tool and material once"), "duplicate");
    rules.proven.push_back(std::move(p));
  }
  r.finish();
}

}  // namespace

ShopRules read_rules(Reader& document, const ShopTargets& known) {
  ShopRules rules;
  auto r = document.optional_object("rules");
  if (!r) return rules;
  rules.forbidden_tools = read_tool_ids(*r, "forbidden_tools", kRules, known);
  for (const auto& item : r->optional_items("speeds", 0, kRules))
    rules.speeds.push_back(read_speed(item, known));
  rules.n_max_rpm = r->optional_number("n_max_rpm", above_up_to(0, 1e6, "rpm"));
  if (const auto proven = r->optional_object("proven"))
    read_all_proven(*proven, known, rules);
  r->finish();
  return rules;
}

catalogue::Shop read_shop(Reader r, const ShopTargets& known) {
  catalogue::Shop shop;
  r = r.as_object();
  read_required_format(r, "turnwright-shop/1");
  shop.id = read_id(r);
  shop.name = r.text("name");
  shop.tools = read_tool_ids(r, "tools", 1000, known);
  shop.rules = read_rules(r, known);
  r.finish();
  return shop;
}

}  // namespace turnwright::document
