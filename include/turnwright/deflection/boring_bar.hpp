#pragma once
#include <optional>

#include "turnwright/deflection/response.hpp"

namespace turnwright::deflection {

/// Deflection of the tip of a boring bar.  z counts from the tool block; the tip is at
/// z = L, at the distance f from the bar's axis:
///
///     y_r = f_ww Fr - f_wp Fa f                                                 (1)
///     y_t = f_ww,t Ft + Ft f^2 int dz/GJ,  J = 2 I                              (2)
///     bore radius error = -y_r + y_t^2/D_bore                                   (3)
///
/// Positive y_r means that the bar yields away from the wall and the bore comes out
/// smaller.  Necks and coolant bores are segments of the bar.  The tool block is a root
/// like a chuck, assumed rigid in torsion.  A compliance measured at the tip replaces
/// f_ww in both planes, for damped and carbide bars whose EI is unknown; the rotation
/// f_wp and the twist are then still those of the drawing.
/// Source: derived here from beam.hpp (4); St. Venant torsion of round bars.
struct BoringBar {
  double tip_offset_mm = 0;                       ///< f
  double bore_diameter_mm = 0;                    ///< D_bore
  std::optional<double> tip_mm_N = std::nullopt;  ///< measured, shank and holder together
};

struct BarTip {
  double y_r_mm = 0, y_t_mm = 0;
  double twist_rad_Nmm = 0;  ///< int dz/GJ
  double bore_radius_error_mm = 0;
};

/// @throws std::domain_error unless D_bore > 0, f >= 0 and a measured compliance >= 0.
BarTip bar_tip(const Beam& bar, const Clamping& block, const BoringBar& at,
               const Load& load);

}  // namespace turnwright::deflection
