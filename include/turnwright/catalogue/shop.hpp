#pragma once
#include <optional>
#include <string>
#include <vector>

#include "turnwright/catalogue/material.hpp"
#include "turnwright/catalogue/tool.hpp"

/// What a shop has and what it holds to, whatever the part.
namespace turnwright::catalogue {

/// Speeds between which the shop cuts.
struct HouseSpeed {
  Range vc_m_min;
  std::optional<std::string> tool = {}, material = {};  ///< ids; absent: any
  std::optional<IsoGroup> group = {};                   ///< of the material; absent: any
};

/// Conditions at which a tool has run well in a material; absent ones are the tool's own.
struct ProvenConditions {
  std::string tool, material;
  std::optional<Range> vc_m_min = {}, f_mm_rev = {}, ap_mm = {};
};

/// Rules of a shop: what it never does, and what it prefers to do.
struct ShopRules {
  std::vector<std::string> forbidden_tools;
  std::vector<HouseSpeed> speeds;
  std::optional<double> n_max_rpm = {};  ///< no spindle runs faster
  std::vector<ProvenConditions> proven;
  double proven_within_pct = 5;  ///< what proven conditions may cost more than others [%]
};

/// A shop's tools, which serve parts that list none, and its rules.
struct Shop {
  std::string id, name;
  std::vector<std::string> tools;  ///< ids; none: every tool of the catalogue
  ShopRules rules;
};

}  // namespace turnwright::catalogue
