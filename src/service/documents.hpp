#pragma once
#include <filesystem>
#include <map>
#include <string>

namespace turnwright::service {

/// The documents of one kind in a data folder, by id.
struct Documents {
  std::map<std::string, std::string> names;
  std::map<std::string, std::string> texts;  ///< JSON, as HTTP and MCP show it
};

/// Those of "materials", "machines", "tools", "shops" and "parts" in `folder`.  The id is the
/// document's own, else the name of its file without ".json".
/// @throws InputError if one cannot be read.
std::map<std::string, Documents> read_documents(const std::filesystem::path& folder);

}  // namespace turnwright::service
