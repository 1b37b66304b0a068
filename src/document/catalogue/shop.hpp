#pragma once
#include <string>
#include <vector>

#include "document/json/reader.hpp"
#include "turnwright/catalogue/shop.hpp"

/// A shop's document and its rules (schemas/shop.json).
namespace turnwright::document {

/// What a shop's document may refer to: tools of every kind, and materials.
struct ShopTargets {
  std::vector<std::string> tools;
  std::vector<catalogue::Material> materials;
  std::string meant = {};  ///< id of the one that is meant where several are called so
};

/// What shops of a Catalogue may refer to; a template, for the catalogue is read with it.
template <class Catalogue>
ShopTargets targets_of(const Catalogue& catalogue) {
  ShopTargets known{{}, catalogue.materials};
  const auto add = [&](const auto& tools) {
    for (const auto& tool : tools) known.tools.push_back(tool.id);
  };
  add(catalogue.tools);
  add(catalogue.fixed_tools);
  add(catalogue.cutters);
  return known;
}

catalogue::Shop read_shop(Reader document, const ShopTargets& known);

/// The member "rules", which may be absent.
catalogue::ShopRules read_rules(Reader& document, const ShopTargets& known);

}  // namespace turnwright::document
