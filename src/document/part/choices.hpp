#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "document/json/reader.hpp"
#include "turnwright/document/catalogue.hpp"
#include "turnwright/document/loaded_part.hpp"

/// What a part document leaves to the planner by "choose": lists of machines, stocks,
/// sequences of setups, or wear lands at which edges are changed.
namespace turnwright::document {

/// The document with one member of each list.
struct Variant {
  std::string name;  ///< "lathe-small; bar 50 x 188 mm"; empty without a choice
  nlohmann::json document;
  /// Where a member of the document stands in the request: "/machine" at
  /// "/choose/machine/0".
  std::vector<std::pair<std::string, std::string>> places = {};
};

/// Every combination, the first members first; the request itself if it leaves no choice.
/// Problems with the lists are added to `problems`, and none is left then.
std::vector<Variant> variants(const nlohmann::json& request, Problems& problems);

/// @throws InputError whose problems stand where the request has them.
LoadedPart load_variant(const Variant& variant, const Catalogue& catalogue,
                        const std::string& document, Purpose purpose = Purpose::plan);

}  // namespace turnwright::document
