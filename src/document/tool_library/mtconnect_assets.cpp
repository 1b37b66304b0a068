#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>

#include "base/say.hpp"
#include "hole_tool_draft.hpp"
#include "library_readers.hpp"

namespace turnwright::document {
namespace {

constexpr std::string_view kAsset = "CuttingTool", kArchetype = "CuttingToolArchetype";

std::string_view local_name(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  return name.substr(name.find(':') + 1);  // npos + 1 is 0
}

pugi::xml_node child_of(const pugi::xml_node& node, std::string_view name) {
  return node.find_child([&](const auto& child) { return local_name(child) == name; });
}

// All assets of a document, without recursion: XML may be deep.
struct Assets : pugi::xml_tree_walker {
  std::vector<pugi::xml_node> found;
  bool for_each(pugi::xml_node& node) override {
    if (local_name(node) == kAsset || local_name(node) == kArchetype)
      found.push_back(node);
    return found.size() <= kMostTools;
  }
};

// Measurements by their code; the text is what was measured, nominal what is meant.
void read_measurements(const pugi::xml_node& of, LibraryTool& t, std::string& wrong) {
  for (const auto& node : child_of(of, "Measurements")) {
    const std::string_view code = node.attribute("code").value();
    const auto symbol = std::ranges::find(symbols(), code, &Symbol::code);
    if (symbol == symbols().end()) continue;
    const auto nominal = node.attribute("nominal");
    const std::string_view text = nominal ? nominal.value() : node.child_value();
    if (text.empty()) continue;
    const auto given = quantity(text);
    if (given && given->unit.empty())
      t.*symbol->member = given->value;
    else
      wrong += say("{}{}: got {}, expected a number", wrong.empty() ? "" : "; ", code,
                   shown(readable(shortened(std::string(text), 60))));
  }
}

bool has_measurement(const pugi::xml_node& of, std::string_view code) {
  const auto list = child_of(of, "Measurements");
  return std::any_of(list.begin(), list.end(), [&](const auto& node) {
    return std::string_view(node.attribute("code").value()) == code;
  });
}

std::string place_of(const pugi::xml_node& asset) {
  const auto id = asset.attribute("assetId");
  return readable(shortened(
      fmt::format("{} {}", local_name(asset), id ? id.value() : tr("without assetId")),
      200));
}

// Why an asset is no turning tool, or "".
std::string no_turning_tool(const pugi::xml_node& life_cycle, std::ptrdiff_t items) {
  for (const char* diameter : {"DC", "DCX"})
    if (has_measurement(life_cycle, diameter))
      return say("It has a cutting diameter ({}): a tool that turns itself.", diameter);
  if (items == 0) return tr("It has no CuttingItem, which would be the insert.");
  if (items > 1) return say("It has {} CuttingItems; a turning tool has one.", items);
  return "";
}

std::optional<LibraryTool> read_asset(const pugi::xml_node& asset, std::string& why) {
  const auto life_cycle = child_of(asset, "CuttingToolLifeCycle");
  const auto items = child_of(life_cycle, "CuttingItems");
  const auto count = std::count_if(items.begin(), items.end(), [](const auto& node) {
    return local_name(node) == "CuttingItem";
  });
  LibraryTool t;
  t.id = readable(asset.attribute("toolId").value());
  t.name = t.id;
  const auto item = child_of(items, "CuttingItem");
  t.use = hole_use(child_of(asset, "Description").child_value());
  if (t.use.empty()) why = no_turning_tool(life_cycle, count);
  if (!why.empty()) return std::nullopt;
  for (const char* text : {item.attribute("itemId").value(), t.id.c_str(),
                           child_of(asset, "Description").child_value()})
    if (*text != '\0') t.texts.push_back(readable(shortened(text, 200)));
  std::string wrong;
  read_measurements(life_cycle, t, wrong);
  read_measurements(item, t, wrong);
  t.boring = t.DMIN_mm || (t.DCON_mm && !t.H_mm);
  if (wrong.empty()) return t;
  why = say("It cannot be read: {}.", wrong);
  return std::nullopt;
}

}  // namespace

ToolLibrary read_mtconnect(std::string_view xml, Problems& problems,
                           const std::string& pointer) {
  ToolLibrary out;
  pugi::xml_document document;
  const auto parsed = document.load_buffer(xml.data(), xml.size());
  Assets assets;
  if (parsed) document.traverse(assets);
  if (!parsed)
    problems.add({pointer, say("byte {}: {}", parsed.offset, parsed.description()),
                  tr("XML (1.0)"), "format"});
  else if (assets.found.empty())
    problems.add({pointer, tr("XML without CuttingTool"),
                  tr("cutting tool assets of MTConnect, <CuttingTool>"), "format"});
  else if (assets.found.size() > kMostTools)
    problems.add({pointer, tr("more assets"), say("at most {}", kMostTools), "limit"});
  if (!parsed || assets.found.size() > kMostTools) return out;
  for (const auto& asset : assets.found) {
    std::string why;
    auto tool = read_asset(asset, why);
    if (tool) {
      tool->at = place_of(asset);
      out.tools.push_back(std::move(*tool));
    } else {
      out.ignored.push_back({place_of(asset), why});
    }
  }
  return out;
}

}  // namespace turnwright::document
