#pragma once
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "turnwright/catalogue/material.hpp"
#include "turnwright/catalogue/tool.hpp"

namespace turnwright::catalogue {

enum class FixedUse { centring, drilling, grooving, threading, profiling, parting };

/// Conditions that the catalogue gives for some groups of materials.
struct FixedConditions {
  std::vector<IsoGroup> groups;
  double vc_m_min = 0;
  double f_mm_rev = 0;  ///< of drills and centre drills: per mm of diameter
  double T_min = 0;     ///< life at these conditions
};

/// A tool whose conditions are not optimised.
struct FixedTool {
  std::string id, name;
  FixedUse use = FixedUse::centring;
  bool inner = false;      ///< works in a bore
  double min_bore_mm = 0;  ///< of an inner tool
  /// Diameters of drills (of centre drills the countersink's), widths of blades, in
  /// rising order; empty for threading and profiling.
  std::vector<double> sizes_mm;
  Range pitch_mm;            ///< of threads
  double reach = 0;          ///< deepest cut: drills in diameters, blades in mm
  double point_deg = 0;      ///< of drills
  double ap_mm = 0;          ///< deepest pass of profiling
  double re_mm = 0;          ///< corner radius of profiling tools
  double passes_per_mm = 0;  ///< infeeds of a thread per mm of pitch
  double gamma_deg = 0;      ///< rake
  std::vector<FixedConditions> conditions;
  std::optional<double> Fc_max_N = {};
  double change_min = 0, edge_cost = 0;

  const FixedConditions* conditions_in(IsoGroup group) const {
    for (const auto& c : conditions)
      if (std::find(c.groups.begin(), c.groups.end(), group) != c.groups.end()) return &c;
    return nullptr;
  }
};

}  // namespace turnwright::catalogue
