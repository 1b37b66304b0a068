#pragma once
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "turnwright/catalogue/material.hpp"
#include "turnwright/catalogue/tool.hpp"

namespace turnwright::catalogue {

enum class FixedUse {
  centring,
  drilling,
  counterboring,
  countersinking,
  reaming,
  tapping,
  grooving,
  threading,
  knurling,
  profiling,
  parting
};

/// Whether a tool works along the axis of the spindle with its whole diameter.
constexpr bool on_axis(FixedUse use) {
  using enum FixedUse;
  return use == centring || use == drilling || use == counterboring ||
         use == countersinking || use == reaming || use == tapping;
}

/// Speeds and feeds from which planning chooses, and how the life goes with them.
struct ConditionsWindow {
  Range vc_m_min;
  Range f_mm_rev;        ///< as FixedConditions::f_mm_rev; of threads the pitch
  double taylor_n = 0;   ///< Taylor's exponent
  double life_feed = 0;  ///< exponent of the feed in the life
};

/// Cutting conditions that the catalogue gives for some groups of materials.
struct FixedConditions {
  std::vector<IsoGroup> groups;
  double vc_m_min = 0;
  double f_mm_rev =
      0;             ///< feed; for drills, centre drills and reamers per mm of diameter
  double T_min = 0;  ///< tool life at these conditions
  std::optional<ConditionsWindow> window = {};  ///< absent: nothing is chosen
};

/// Other conditions, with the life that follows from the window's exponents (Taylor's
/// equation, extended by the feed):
///
///     T = T0 (vc0/vc)^(1/n) (f0/f)^y                                                 (1)
///
/// Without a window the life stays.  Of threads, whose feed is no condition, f does not
/// count.
FixedConditions at(const FixedConditions& conditions, double vc_m_min, double f_mm_rev);

/// The conditions of a tool in one of its sizes: feeds of tools on the axis, of taps apart,
/// grow with the diameter.
FixedConditions of_size(FixedConditions conditions, FixedUse use, double size_mm);

/// What a drill, a flat drill or a reamer leaves: the ISO 286 grade above its diameter (of a
/// reamer the tolerance class H of that grade), and the roughness.
struct DrilledHole {
  int grade = 0;
  double Ra_um = 0;
};

/// How a drill without coolant of its own brings out its chips: down to `first_diameters` in
/// one feed, then out of the hole after every `step_diameters` at most.
struct Pecking {
  double first_diameters = 0, step_diameters = 0;
};

/// A thread that a tap cuts.
struct ThreadSize {
  std::string designation;
  double d_mm = 0, pitch_mm = 0;
};

/// A tool whose passes are fixed, and its conditions where they have no window.
struct FixedTool {
  std::string id, name;
  FixedUse use = FixedUse::centring;
  bool inner = false;      ///< works in a bore
  double min_bore_mm = 0;  ///< smallest bore that an inner tool enters
  /// Diameters of drills (for centre drills of the countersink), countersinks and reamers
  /// or widths of blades and knurling wheels, in rising order; empty for other tools.
  std::vector<double> sizes_mm;
  /// Of a centre drill: depth of its tip where the hole has its size, one for each size.
  std::vector<double> depths_mm = {};
  Range pitch_mm;    ///< pitches of threads or knurls that it makes
  double reach = 0;  ///< deepest cut: of tools on the axis in diameters, of blades in mm
  std::vector<ThreadSize> threads = {};  ///< of taps
  Range allowance_mm = {};  ///< of the diameter, that a reamer takes off a drilled hole
  double lead = 0;  ///< length of the tapered front: of reamers in mm, of taps in pitches
  int edges = 0;    ///< of flat drills, countersinks, reamers and taps
  double point_deg = 0;  ///< point angle of a drill or a countersink, 180 of flat drills
  char form = 'A';       ///< of centre drills: that of ISO 6411
  std::optional<DrilledHole> hole = {};  ///< absent: what it drills is bored
  std::optional<Pecking> pecking = {};   ///< absent: it drills every hole in one feed
  double ap_mm = 0;                      ///< largest depth of a profiling pass
  double re_mm = 0;                      ///< corner radius of profiling tools
  double passes_per_mm = 0;              ///< infeeds of a thread per mm of pitch
  double gamma_deg = 0;                  ///< rake; knurling wheels have none
  std::vector<FixedConditions> conditions;
  std::optional<double> Fc_max_N = {};
  double change_min = 0, edge_cost = 0;

  const FixedConditions* conditions_in(IsoGroup group) const {
    for (const auto& c : conditions)
      if (std::find(c.groups.begin(), c.groups.end(), group) != c.groups.end()) return &c;
    return nullptr;
  }
};

/// Depth [mm] of a centre drill's tip where the hole has the tool's size that is at least as
/// large, or its largest.
inline double tip_depth_mm(const FixedTool& centre_drill, double size_mm) {
  const auto& sizes = centre_drill.sizes_mm;
  const auto at = std::ranges::lower_bound(sizes, size_mm) - sizes.begin();
  return centre_drill.depths_mm.at(
      std::min(static_cast<std::size_t>(at), sizes.size() - 1));
}

/// The thread of a diameter and a pitch among those that a tap cuts; none.
inline const ThreadSize* thread_of(const FixedTool& tap, double d_mm, double pitch_mm) {
  const auto it = std::ranges::find_if(tap.threads, [&](const ThreadSize& t) {
    return std::abs(t.d_mm - d_mm) < 1e-6 && std::abs(t.pitch_mm - pitch_mm) < 1e-6;
  });
  return it == tap.threads.end() ? nullptr : &*it;
}

}  // namespace turnwright::catalogue
