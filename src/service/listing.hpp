#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "turnwright/document/catalogue.hpp"

namespace turnwright::service {

/// One line of a list: what documents call it and what people call it.
struct Entry {
  std::string id, name;
};

std::vector<Entry> list_materials(const document::Catalogue& catalogue);
std::vector<Entry> list_tools(const document::Catalogue& catalogue);
std::vector<Entry> list_machines(const document::Catalogue& catalogue);
std::vector<Entry> list_shops(const document::Catalogue& catalogue);

/// The reference parts in `folder`/parts, in the order of their file names; the id is the
/// file's name without ".json".  @throws InputError if one is no JSON object with a name.
std::vector<Entry> list_parts(const std::filesystem::path& folder);

/// The schemas in `folder`/schemas; the id is the file's name without ".json".
std::vector<Entry> list_schemas(const std::filesystem::path& folder);

/// The text of the schema of this id in the list.
std::string schema_text(const std::filesystem::path& folder, const std::string& id);

/// The text of a schema: that of its id ("part", "plan.result"), or of the request of a
/// capability ("plan").
/// @throws InputError if there is none, with the most similar name.
std::string schema(const std::filesystem::path& folder, const std::string& name);

}  // namespace turnwright::service
