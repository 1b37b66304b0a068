#include "turnwright/deflection/boring_bar.hpp"

#include <cmath>
#include <stdexcept>

namespace turnwright::deflection {

BarTip bar_tip(const Beam& bar, const Clamping& block, const BoringBar& at,
               const Load& load) {
  const double f = at.tip_offset_mm, D = at.bore_diameter_mm, L = bar.length_mm();
  if (!(D > 0 && f >= 0 && std::isfinite(f)))
    throw std::domain_error("bar_tip: D_bore must be > 0 mm and the offset >= 0 mm");
  if (at.tip_mm_N && !(*at.tip_mm_N >= 0 && std::isfinite(*at.tip_mm_N)))
    throw std::domain_error("bar_tip: a measured compliance must be >= 0 mm/N");
  const auto tip = [&](Supports held) {
    held.method = Method::chuck;  // nothing supports the tip
    Flexibility at_tip = bar.at(L, held);
    at_tip.f_ww_mm_N = at.tip_mm_N.value_or(at_tip.f_ww_mm_N);
    return at_tip;
  };
  const Flexibility r = tip(block.radial), t = tip(block.tangential);
  const double twist = bar.twist_rad_Nmm();
  const double y_r = r.f_ww_mm_N * load.Fr_N - r.f_wp_rad_N * load.Fa_N * f;  // Eq. (1)
  const double y_t = (t.f_ww_mm_N + f * f * twist) * load.Ft_N;               // Eq. (2)
  return {.y_r_mm = y_r,
          .y_t_mm = y_t,
          .twist_rad_Nmm = twist,
          .bore_radius_error_mm = -y_r + y_t * y_t / D};  // Eq. (3)
}

}  // namespace turnwright::deflection
