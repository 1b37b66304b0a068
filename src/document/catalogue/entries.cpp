#include "entries.hpp"

#include "catalogue_readers.hpp"
#include "document/json/reference.hpp"
#include "material_names.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::document {
namespace {

/// What is expected of a reference, in English.
struct Wanted {
  const char* reference;  ///< or of a document in its place
  const char* id;
};
constexpr Wanted kMaterial{to_translate("the id of a material or its document"),
                           to_translate("a material of the catalogue")},
    kMachine{to_translate("the id of a machine or its document"),
             to_translate("a machine of the catalogue")},
    kTool{to_translate("the id of a tool or its document"),
          to_translate("a tool of the catalogue")},
    kCutter{to_translate("the id of a milling cutter or its document"),
            to_translate("a milling cutter of the catalogue")},
    kShop{to_translate("the id of a shop or its document"),
          to_translate("a shop of the catalogue")};

template <class T, class Read>
T resolve(const Reader& value, const std::vector<T>& entries, const Read& read,
          const Wanted& wanted, const std::vector<std::string>& others = {}) {
  if (value.is_object()) return read(value);
  if (value.broken()) return {};
  if (!value.is_text()) {
    value.problem(tr(wanted.reference), "type");
    return {};
  }
  const auto id = value.json().get<std::string>();
  for (const auto& entry : entries)
    if (entry.id == id) return entry;
  auto known = ids(entries);
  known.insert(known.end(), others.begin(), others.end());
  value.problem(expected_reference(id, known, tr(wanted.id)), "unknown-id");
  return {};
}

}  // namespace

catalogue::Material material_of(const Catalogue& catalogue, const Reader& value) {
  if (value.is_text()) {
    const auto found =
        materials_called(value.json().get<std::string>(), catalogue.materials);
    if (found.size() == 1) return found.front();
    if (found.size() > 1) {
      value.problem(expected_state(found), "ambiguous");
      return {};
    }
  }
  return resolve(value, catalogue.materials, read_material, kMaterial);
}

catalogue::Lathe machine_of(const Catalogue& catalogue, const Reader& value) {
  return resolve(value, catalogue.machines, read_lathe, kMachine);
}

catalogue::Tool tool_of(const Catalogue& catalogue, const Reader& value) {
  return resolve(value, catalogue.tools, read_tool, kTool, ids(catalogue.fixed_tools));
}

catalogue::FixedTool fixed_tool_of(const Catalogue& catalogue, const Reader& value) {
  return resolve(value, catalogue.fixed_tools, read_fixed_tool, kTool);
}

catalogue::MillingCutter cutter_of(const Catalogue& catalogue, const Reader& value) {
  return resolve(value, catalogue.cutters, read_milling_cutter, kCutter);
}

catalogue::Shop shop_of(const Catalogue& catalogue, const Reader& value) {
  const auto read = [&](const Reader& r) { return read_shop(r, targets_of(catalogue)); };
  return resolve(value, catalogue.shops, read, kShop);
}

}  // namespace turnwright::document
