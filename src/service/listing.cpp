#include "listing.hpp"

#include <algorithm>

#include "document/json/file.hpp"
#include "document/json/reader.hpp"
#include "turnwright/base/errors.hpp"

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

std::vector<Entry> list_parts(const std::filesystem::path& folder) {
  std::vector<Entry> list;
  if (!std::filesystem::is_directory(folder / "parts")) return list;
  for (const auto& file : std::filesystem::directory_iterator(folder / "parts")) {
    if (file.path().extension() != ".json") continue;
    const auto json = document::parse_file(file.path());
    document::Problems problems{.document = file.path().string()};
    std::string name = document::Reader(json, problems).as_object().text("name");
    problems.throw_if_any();
    list.push_back({file.path().stem().string(), std::move(name)});
  }
  std::sort(list.begin(), list.end(),
            [](const Entry& a, const Entry& b) { return a.id < b.id; });
  return list;
}

}  // namespace turnwright::service
