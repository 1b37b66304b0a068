#pragma once
#include <optional>
#include <string>

namespace turnwright::catalogue {

/// ISO 513 application groups.
enum class IsoGroup { P, M, K, N, S, H };

/// Kienzle's specific force of one component: k = k1.1 h^-m, at h = b = 1 mm.
struct Kienzle {
  double k11_MPa = 0;
  double m = 0;
};

/// T = (C / (vc f^a ap^b))^(1/n): vc [m/min], f [mm/rev], ap [mm], T [min].
struct Taylor {
  double C = 0, n = 0, a = 0, b = 0;
};

struct Material {
  std::string id, name, standard, condition;
  IsoGroup group = IsoGroup::P;
  double hardness_HB = 0;
  double E_MPa = 0, nu = 0, rho_kg_m3 = 0, expansion_1_K = 0;
  Kienzle kc;                     ///< cutting force: kc1.1, mc
  double gamma0_deg = 0;          ///< rake for which kc1.1 holds
  double kc_uncertainty_pct = 0;  ///< one standard deviation
  std::optional<Kienzle> kf, kp;  ///< feed and passive force, both or neither
  Taylor taylor;
  double taylor_uncertainty_pct = 0;  ///< of C
  double hmin_mm = 0;                 ///< least chip thickness (Brammertz), 0 = ideal
};

}  // namespace turnwright::catalogue
