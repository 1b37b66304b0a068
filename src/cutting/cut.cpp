#include "turnwright/cutting/cut.hpp"

#include "turnwright/base/units.hpp"
#include "turnwright/cutting/fixed.hpp"

namespace turnwright::cutting {

Corner corner_of(double re_mm, double kapr_rad) {
  return {re_mm,
          kapr_rad,
          std::sin(kapr_rad),
          1 / std::tan(kapr_rad),
          std::tan(kapr_rad / 2),
          re_mm * (1 - std::cos(kapr_rad))};
}

double hmin_mm(const catalogue::Material& material, const catalogue::Tool& tool) {
  if (!(material.hmin_edge_um > 0 && tool.edge_um > 0)) return material.hmin_mm;
  return material.hmin_mm * tool.edge_um / material.hmin_edge_um;  // Eq. (9)
}

Cut cut_of(const catalogue::Material& material, const catalogue::Tool& tool) {
  Cut c;
  c.kc = kienzle_at(material, tool.gamma_deg);
  c.thrust = catalogue::thrust_of(material);
  c.kf = material.kf;
  c.kp = material.kp;
  c.taylor = material.taylor;
  c.corner = corner_of(tool.re_mm, units::rad_from_deg(tool.kapr_deg));
  c.minor_kapr_rad = units::rad_from_deg(tool.minor_kapr_deg);
  c.hmin_mm = hmin_mm(material, tool);
  c.land_Ra_um_mm = material.land_Ra_um_mm;
  c.surface_factor = tool.wiper ? 0.5 : 1.0;
  return c;
}

Cut worn(Cut c, double VB_mm, double VB_end_mm) {
  constexpr double kFriction = 0.4;
  c.land_N_mm = c.thrust.land_MPa * VB_mm;
  c.land_Fc_N_mm = kFriction * c.land_N_mm;
  c.land_Ra_um = c.land_Ra_um_mm * VB_mm;
  c.taylor.C *= std::pow(VB_mm / VB_end_mm, c.taylor.n);  // Eq. (8)
  return c;
}

double economic_life_min(const Cut& c, double change_min, double edge_over_minute) {
  return (1 / c.taylor.n - 1) * (change_min + edge_over_minute);
}

}  // namespace turnwright::cutting
