#include "entries.hpp"

#include "catalogue_readers.hpp"
#include "document/json/reference.hpp"
#include "material_names.hpp"

namespace turnwright::document {
namespace {

template <class T, class Read>
T resolve(const Reader& value, const std::vector<T>& entries, const Read& read,
          const std::string& what, const std::vector<std::string>& others = {}) {
  if (value.is_object()) return read(value);
  if (value.broken()) return {};
  if (!value.is_text()) {
    value.problem("the id of a " + what + " or its document", "type");
    return {};
  }
  const auto id = value.json().get<std::string>();
  for (const auto& entry : entries)
    if (entry.id == id) return entry;
  auto known = ids(entries);
  known.insert(known.end(), others.begin(), others.end());
  value.problem(expected_reference(id, known, "a " + what + " of the catalogue"),
                "unknown-id");
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
  return resolve(value, catalogue.materials, read_material, "material");
}

catalogue::Lathe machine_of(const Catalogue& catalogue, const Reader& value) {
  return resolve(value, catalogue.machines, read_lathe, "machine");
}

catalogue::Tool tool_of(const Catalogue& catalogue, const Reader& value) {
  return resolve(value, catalogue.tools, read_tool, "tool", ids(catalogue.fixed_tools));
}

catalogue::FixedTool fixed_tool_of(const Catalogue& catalogue, const Reader& value) {
  return resolve(value, catalogue.fixed_tools, read_fixed_tool, "tool");
}

catalogue::MillingCutter cutter_of(const Catalogue& catalogue, const Reader& value) {
  return resolve(value, catalogue.cutters, read_milling_cutter, "milling cutter");
}

catalogue::Shop shop_of(const Catalogue& catalogue, const Reader& value) {
  const auto read = [&](const Reader& r) { return read_shop(r, targets_of(catalogue)); };
  return resolve(value, catalogue.shops, read, "shop");
}

}  // namespace turnwright::document
