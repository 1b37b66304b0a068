#include "turnwright/deflection/response.hpp"

#include <stdexcept>

namespace turnwright::deflection {

Response response(double a_mm, double D_mm, const Flexibility& radial,
                  const Flexibility& tangential, const Load& load) {
  if (!(D_mm > 0)) throw std::domain_error("response: D must be > 0 mm");
  const double Fr = load.Fr_N, D = D_mm;
  const double C = -load.Fa_N * D / 2;                                   // Eq. (1)
  const double delta_r = radial.f_ww_mm_N * Fr + radial.f_wp_rad_N * C;  // Eq. (2)
  const double theta_r = radial.f_wp_rad_N * Fr + radial.f_pp_rad_Nmm * C;
  const double delta_t = tangential.f_ww_mm_N * load.Ft_N;  // Eq. (3)
  return {.a_mm = a_mm,
          .D_mm = D,
          .radial = radial,
          .tangential = tangential,
          .delta_r_mm = delta_r,
          .delta_t_mm = delta_t,
          .theta_r_rad = theta_r,
          .radius_error_mm = delta_r + delta_t * delta_t / D,  // Eq. (4)
          .tail_reaction_N = radial.tail_per_N * Fr + radial.tail_per_Nmm * C};
}

std::vector<Response> responses(const Workpiece& part, const Clamping& clamping,
                                std::span<const double> a_mm, const Load& load) {
  std::vector<Flexibility> radial(a_mm.size()), tangential(a_mm.size());
  part.at(a_mm, clamping.radial, radial);
  part.at(a_mm, clamping.tangential, tangential);
  std::vector<Response> all;
  all.reserve(a_mm.size());
  for (std::size_t i = 0; i < a_mm.size(); ++i)
    all.push_back(response(a_mm[i], part.diameter_mm(part.segment_at(a_mm[i]), a_mm[i]),
                           radial[i], tangential[i], load));
  return all;
}

}  // namespace turnwright::deflection
