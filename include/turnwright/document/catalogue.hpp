#pragma once
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "turnwright/catalogue/fixed_tool.hpp"
#include "turnwright/catalogue/machine.hpp"
#include "turnwright/catalogue/material.hpp"
#include "turnwright/catalogue/milling_cutter.hpp"
#include "turnwright/catalogue/shop.hpp"
#include "turnwright/catalogue/tool.hpp"

/// Materials, tools and machines as documents, whose keys are defined by
/// schemas/material.json, schemas/tool.json, schemas/fixed-tool.json,
/// schemas/milling-cutter.json, schemas/lathe.json and schemas/shop.json.
namespace turnwright::document {

/// Everything that a request may refer to by id; each list is in the order of ids.
struct Catalogue {
  std::vector<catalogue::Material> materials;
  std::vector<catalogue::Tool> tools;
  std::vector<catalogue::FixedTool> fixed_tools;
  std::vector<catalogue::MillingCutter> cutters;
  std::vector<catalogue::Lathe> machines;
  std::vector<catalogue::Shop> shops;
  /// As written, by id.
  std::map<std::string, nlohmann::json> material_documents, machine_documents;
};

/// The *.json files in materials/, tools/, tools/fixed/, tools/milling/, machines/ and
/// shops/ of `folder`.
/// @throws InputError with all problems over all files; their pointers start with the
///   file, "materials/C45.json#/kienzle/mc".
Catalogue load_catalogue(const std::filesystem::path& folder);

/// The folder of the catalogue: `given`; otherwise TURNWRIGHT_DATA of the environment,
/// then share/turnwright of the installation, then the source tree of the build.
/// @throws InputError if `given` or TURNWRIGHT_DATA has no materials/, or none is found.
std::filesystem::path data_folder(
    const std::optional<std::filesystem::path>& given = std::nullopt);

}  // namespace turnwright::document
