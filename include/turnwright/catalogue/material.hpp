#pragma once
#include <optional>
#include <string>
#include <vector>

namespace turnwright::catalogue {

/// ISO 513 application groups.
enum class IsoGroup { P, M, K, N, S, H };

/// Kienzle's specific force of one component: k = k1.1 h^-m, at h = b = 1 mm.
struct Kienzle {
  double k11_MPa = 0;
  double m = 0;
};

/// Thrust force in the plane of feed and depth, F_D = lambda Fc + ke L: L the engaged
/// length of the edge, ke the ploughing of a rounded edge that is not worn.
struct Thrust {
  double ratio = 0.4;           ///< lambda
  double edge_N_mm = 0;         ///< ke
  double uncertainty_pct = 20;  ///< of F_D, one standard deviation
  double land_MPa = 0;          ///< pressure on the wear land of an edge
  /// Of F_D with the uncertainty of kc in it, where F_D itself was found from parts.
  std::optional<double> total_uncertainty_pct = {};
};

/// T = (C / (vc f^a ap^b))^(1/n): vc [m/min], f [mm/rev], ap [mm], T [min].  Both laws of
/// the depth agree at 1 mm.
struct Taylor {
  double C = 0, n = 0, a = 0, b = 0;
  std::optional<double> b_shallow = {};  ///< in place of b below a depth of 1 mm
};

struct Material {
  std::string id, name, standard, condition;
  std::vector<std::string> synonyms = {};  ///< numbers and names in other standards
  IsoGroup group = IsoGroup::P;
  double hardness_HB = 0;
  std::optional<double> yield_MPa = {};  ///< yield or 0.2 % proof strength
  double E_MPa = 0, nu = 0, rho_kg_m3 = 0, expansion_1_K = 0;
  Kienzle kc;                     ///< cutting force: kc1.1, mc
  double gamma0_deg = 0;          ///< rake for which kc1.1 holds
  double kc_uncertainty_pct = 0;  ///< one standard deviation
  std::optional<Thrust> thrust;   ///< none: thrust_of estimates it
  std::optional<Kienzle> kf, kp;  ///< feed and passive force, both or neither
  double feed_passive_uncertainty_pct = 0;
  Taylor taylor;
  double taylor_uncertainty_pct = 0;  ///< of C
  double life_scatter_pct = 0;        ///< of ln T between edges, one standard deviation
  double hmin_mm = 0;                 ///< least chip thickness (Brammertz), 0 = ideal
  double hmin_uncertainty_pct = 0;    ///< one standard deviation
  double hmin_edge_um = 0;   ///< radius of the rounded edge that hmin belongs to; 0: any
  double land_Ra_um_mm = 0;  ///< Ra of the grooves of a wear land, per VB; 0: not known
  double land_Ra_uncertainty_pct = 0;  ///< one standard deviation
};

/// The material's thrust force, or where it has none an estimate,
///
///     lambda = 0.4,  ke = 0.033 mm kc1.1,  uncertainty 20 %,                         (1)
///     pressure on the wear land 0.58 kc1.1, also where the rest is given             (2)
///
/// lambda is the tangent of the angle between friction and rake (22 deg), ke the pressure
/// at a rounded edge, taken in proportion to the work's strength.
/// Source: an estimate, chosen on 27 measured cuts of H13 steel [Rigueto Canal 2022] with
/// the constants of the nearest catalogue steel; not compared for other materials.  With
/// (2), 990 MPa in that steel, a land of 0.3 mm makes Fp 3.0 to 3.4 times as large, where
/// 3.3 to 3.6 times were measured.  docs/reality.md has the comparison.
inline Thrust thrust_of(const Material& material) {
  constexpr double kEdge_mm = 0.033;
  constexpr double kLand = 0.58;
  Thrust estimate;
  estimate.edge_N_mm = kEdge_mm * material.kc.k11_MPa;
  Thrust t = material.thrust.value_or(estimate);
  if (!(t.land_MPa > 0)) t.land_MPa = kLand * material.kc.k11_MPa;
  return t;
}

}  // namespace turnwright::catalogue
