#include "documents.hpp"

#include "document/json/file.hpp"

namespace turnwright::service {

std::map<std::string, Documents> read_documents(const std::filesystem::path& folder) {
  std::map<std::string, Documents> all;
  for (const char* kind : {"materials", "machines", "tools", "shops", "parts"}) {
    auto& of_kind = all[kind];
    if (!std::filesystem::is_directory(folder / kind)) continue;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(folder / kind)) {
      if (entry.path().extension() != ".json") continue;
      const auto document = document::parse_file(entry.path());
      const auto id = document.value("id", entry.path().stem().string());
      of_kind.names[id] = document.value("name", id);
      of_kind.texts[id] = document.dump(2) + '\n';
    }
  }
  return all;
}

}  // namespace turnwright::service
