#pragma once
#include <string>
#include <vector>

#include "document/json/reader.hpp"
#include "shop.hpp"
#include "turnwright/document/catalogue.hpp"

/// Entries of the catalogue, which a request names by id or gives as documents.  Errors
/// are added to the problems of `value`.
namespace turnwright::document {

/// A material may also be named by its name or a synonym (material_names.hpp).
catalogue::Material material_of(const Catalogue& catalogue, const Reader& value);
catalogue::Lathe machine_of(const Catalogue& catalogue, const Reader& value);
/// An unknown id is reported with the ids of tools for fixed operations, too.
catalogue::Tool tool_of(const Catalogue& catalogue, const Reader& value);
catalogue::FixedTool fixed_tool_of(const Catalogue& catalogue, const Reader& value);
catalogue::MillingCutter cutter_of(const Catalogue& catalogue, const Reader& value);

catalogue::Shop shop_of(const Catalogue& catalogue, const Reader& value);

template <class T>
std::vector<std::string> ids(const std::vector<T>& entries) {
  std::vector<std::string> out;
  for (const auto& entry : entries) out.push_back(entry.id);
  return out;
}

}  // namespace turnwright::document
