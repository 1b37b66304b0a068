#pragma once
#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "turnwright/catalogue/geometric_errors.hpp"
#include "turnwright/catalogue/live_centre.hpp"
#include "turnwright/catalogue/milling_cutter.hpp"
#include "turnwright/catalogue/tool.hpp"

namespace turnwright::catalogue {

struct CurvePoint {
  double n_rpm = 0, P_kW = 0, M_Nm = 0;
};

struct CentreCompliance {
  double radial_mm_N = 0, tangential_mm_N = 0;
};

/// Three-jaw chuck: compliance and grip (VDI 3106).
struct Chuck {
  RootCompliance radial, tangential;
  double axial_mm_N = 0;            ///< axial compliance of the held part and the spindle
  double grip_force_N = 0;          ///< total gripping force at rest, Fsp0
  double jaw_mass_radius_kg_m = 0;  ///< sum of m r over all jaws
  double friction = 0;              ///< mu_sp between jaws and part
  double n_max_rpm = 0;
  Range diameter_mm;  ///< diameters that it can hold
};

/// Driven spindles of the turret, for milling cutters.
struct DrivenTools {
  double n_min_rpm = 0, n_max_rpm = 0;
  std::vector<CurvePoint> curve;  ///< as for the main spindle
  double efficiency = 0;
  double feed_max_mm_min = 0;
  std::map<std::string, std::vector<TipMode>> modes;  ///< measured, by id of the cutter
  bool c_axis =
      false;  ///< the main spindle turns the part to an angle and holds it there
  double y_max_mm =
      0;  ///< way of the axis Y to either side of the spindle's axis, 0: none
};

/// Eccentricity of a part that is held anew, standard deviation of each component [um].
struct Rechucking {
  double hard_jaws_um = 0, soft_jaws_um = 0, collet_um = 0, centres_um = 0;
};

/// What else than the cut moves sizes and run-outs on a machine in ordinary production,
/// for requests that do not say; here the estimate for machines that do not say either
/// (machines/lathe-medium.json has its sources).
struct ShopBudget {
  Rechucking rechucking = {6, 2, 1.5, 0.7};
  double drift_um = 1;                 ///< between two corrections, radial, +-
  double drift_axial_um = 2;           ///< and along the axis
  double repeatability_um = 0.4;       ///< edge's place from part to part, one sigma
  double part_warm_K = 2;              ///< finishing finds the part so much too warm
  double life_between_offsets = 0.03;  ///< share of an edge's life between corrections
};
/// Minutes to change the jaws' force in the middle of a setup where a machine's document
/// has none.  An estimate: turn the valve of the chuck's pressure, read the gauge, start.
inline constexpr double kJaws_min = 0.25;

/// Stations of a turret that bounds no setup.
inline constexpr int kAnyStations = std::numeric_limits<int>::max();

struct Lathe {
  std::string id, name;
  double n_min_rpm = 0, n_max_rpm = 0;
  std::vector<CurvePoint> curve;  ///< spindle motor, rising n; log-log between points
  double efficiency = 0;          ///< spindle to cut
  double feed_force_max_N = 0;
  double rapid_mm_min = 0;
  double index_min = 0;         ///< time to bring in another tool [min]
  double load_min = 0;          ///< part in and out, per setup [min]
  double tailstock_min = 0;     ///< extra with tailstock: its quill [min]
  double centres_min = 0;       ///< extra between centres: held end centred, driver [min]
  double steady_min = 0;        ///< extra with a steady rest: setting its rollers [min]
  double follow_min = 0;        ///< extra with a follow rest: setting its jaws [min]
  double jaws_min = kJaws_min;  ///< stop to change the force of the jaws [min]
  double setup_min = 0;         ///< preparing the machine, per setup and batch [min]
  double cost_per_min = 0;      ///< used when the request gives no rate
  std::string currency = {};    ///< of that rate and of edges, as "EUR"; empty: not named
  double swing_mm = 0, between_centres_mm = 0;
  int stations = kAnyStations;  ///< of the turret, for the tools of a setup
  Chuck chuck;
  CentreCompliance tail_centre, head_centre, steady_rest, follow_rest;
  double tail_thrust_N = 0;  ///< thrust of the tailstock on the part
  LiveCentre live_centre = {};
  double tool_rr_mm_N = 0;  ///< toolpost: radial deflection per radial force
  double tool_rt_mm_N = 0;  ///< and per tangential force (usually towards the work)
  /// Its axial deflection per axial force, for chatter; none: chatter along the feed is not
  /// counted.
  std::optional<double> tool_zz_mm_N = {};
  double stiffness_uncertainty_pct = 0;
  ShopBudget budget = {};
  std::optional<GeometricErrors> errors = {};
  std::optional<DrivenTools> driven_tools = {};
  std::optional<double> damping_ratio = {};  ///< of slender work and boring bars
  std::vector<std::string> clampings;        ///< "chuck", "chuck-tailstock", ...
  bool has(std::string_view clamping) const {
    return std::find(clampings.begin(), clampings.end(), clamping) != clampings.end();
  }
};

}  // namespace turnwright::catalogue
