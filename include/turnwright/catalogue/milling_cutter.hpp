#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "turnwright/catalogue/material.hpp"
#include "turnwright/catalogue/tool.hpp"

namespace turnwright::catalogue {

/// A vibration mode of the cutter's tip in its driven holder.
struct TipMode {
  bool along_feed = true;  ///< true: along the feed, false: across it
  double frequency_Hz = 0, damping_ratio = 0, stiffness_N_mm = 0;
};

/// Cutting conditions that the grade allows in some groups of materials.
struct MillingConditions {
  std::vector<IsoGroup> groups;
  Range vc_m_min;
  Range hex_mm;  ///< range of the largest chip thickness along a tooth's path
  /// Tool life T = T0 (v0/vc)^(1/n).
  double T0_min = 0, v0_m_min = 0, n = 0;
};

/// A shank cutter with a square corner (kappa 90 deg); ISO 13399 symbols.
struct MillingCutter {
  std::string id, name;
  double dc_mm = 0;             ///< cutting diameter DC
  int teeth = 0;                ///< effective edges ZEFP, alike and equally spaced
  double re_mm = 0;             ///< corner radius RE
  double lu_mm = 0;             ///< usable length LU: the deepest floor it reaches
  double gamma_deg = 0;         ///< radial rake
  bool centre_cutting = false;  ///< whether it can plunge into solid material
  Range ap_mm;                  ///< axial depth, to APMXS
  std::vector<MillingConditions> conditions;
  double Fc_max_N = 0;         ///< largest tangential force on all its teeth
  std::vector<TipMode> modes;  ///< estimate, used where the machine has none measured
  double change_min = 0, edge_cost = 0;

  const MillingConditions* conditions_in(IsoGroup group) const {
    for (const auto& c : conditions)
      if (std::find(c.groups.begin(), c.groups.end(), group) != c.groups.end()) return &c;
    return nullptr;
  }
};

}  // namespace turnwright::catalogue
