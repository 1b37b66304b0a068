#include "listing.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string_view>

#include "document/json/file.hpp"
#include "document/json/reader.hpp"
#include "document/json/reference.hpp"
#include "requests.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::service {
namespace {

template <class T>
std::vector<Entry> entries(const std::vector<T>& items) {
  std::vector<Entry> list;
  for (const auto& item : items) list.push_back({item.id, item.name});
  return list;
}

}  // namespace

std::vector<Entry> list_materials(const document::Catalogue& catalogue) {
  return entries(catalogue.materials);
}

std::vector<Entry> list_tools(const document::Catalogue& catalogue) {
  auto list = entries(catalogue.tools);
  for (const auto& more : {entries(catalogue.fixed_tools), entries(catalogue.cutters)})
    list.insert(list.end(), more.begin(), more.end());
  std::sort(list.begin(), list.end(),
            [](const Entry& a, const Entry& b) { return a.id < b.id; });
  return list;
}

std::vector<Entry> list_machines(const document::Catalogue& catalogue) {
  return entries(catalogue.machines);
}

std::vector<Entry> list_shops(const document::Catalogue& catalogue) {
  return entries(catalogue.shops);
}

namespace {

// Every *.json file in a folder, called by its member `name_key`.
std::vector<Entry> list_folder(const std::filesystem::path& folder,
                               std::string_view name_key) {
  std::vector<Entry> list;
  if (!std::filesystem::is_directory(folder)) return list;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    if (file.path().extension() != ".json") continue;
    const auto json = document::parse_file(file.path());
    document::Problems problems{.document = file.path().string()};
    std::string name = document::Reader(json, problems).as_object().text(name_key);
    problems.throw_if_any();
    list.push_back({file.path().stem().string(), std::move(name)});
  }
  std::sort(list.begin(), list.end(),
            [](const Entry& a, const Entry& b) { return a.id < b.id; });
  return list;
}

}  // namespace

std::vector<Entry> list_parts(const std::filesystem::path& folder) {
  return list_folder(folder / "parts", "name");
}

std::vector<Entry> list_schemas(const std::filesystem::path& folder) {
  return list_folder(folder / "schemas", "title");
}

std::string schema_text(const std::filesystem::path& folder, const std::string& id) {
  std::ifstream in(folder / "schemas" / (id + ".json"), std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string schema(const std::filesystem::path& folder, const std::string& name) {
  const auto* row = find_request(name);
  const auto id =
      row ? std::filesystem::path(request_schema(*row)).stem().string() : name;
  std::vector<std::string> ids;
  for (const auto& entry : list_schemas(folder)) ids.push_back(entry.id);
  if (std::find(ids.begin(), ids.end(), id) == ids.end())
    throw InputError(
        tr("command line"),
        {{"NAME", '"' + name + '"',
          document::expected_reference(name, ids, tr("a schema")), "choice"}});
  return schema_text(folder, id);
}

}  // namespace turnwright::service
