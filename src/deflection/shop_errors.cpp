#include "turnwright/deflection/shop_errors.hpp"

#include <cmath>
#include <stdexcept>

#include "turnwright/base/units.hpp"

namespace turnwright::deflection {
namespace {

double checked(double compliance_mm_N) {
  if (!(compliance_mm_N >= 0 && std::isfinite(compliance_mm_N)))
    throw std::domain_error("toolpost: c_rr must be >= 0 mm/N");
  return compliance_mm_N;
}

}  // namespace

double heat_error_mm(double alpha_per_K, double dT_K, double D_mm) {
  if (!(alpha_per_K >= 0 && D_mm > 0 && std::isfinite(dT_K)))
    throw std::domain_error("heat_error: alpha must be >= 0 /K and D > 0 mm");
  return -alpha_per_K * dT_K * D_mm / 2;  // Eq. (1)
}

double wear_error_mm(double VB_mm, const Edge& edge, double life_used) {
  const double alpha = edge.alpha_o_rad, gamma = edge.gamma_o_rad;
  const double right = units::kPi / 2;
  if (!(VB_mm >= 0 && alpha > 0 && alpha + gamma < right && gamma > -right &&
        alpha < right))
    throw std::domain_error("wear_error: VB must be >= 0 mm, the edge a wedge");
  if (!(life_used >= 0 && life_used <= 1))
    throw std::domain_error("wear_error: the life used must be in [0, 1]");
  const double t = std::tan(alpha);
  return life_used * VB_mm * t / (1 - t * std::tan(gamma));  // Eq. (2)
}

double toolpost_error_mm(const Toolpost& post, const Load& load) {
  return checked(post.c_rr_mm_N) * load.Fr_N + post.c_rt_mm_N * load.Ft_N;  // Eq. (3)
}

Flexibility with_toolpost(const Flexibility& radial, const Toolpost& post,
                          double Ft_over_Fr) {
  Flexibility both = radial;
  both.f_ww_mm_N += checked(post.c_rr_mm_N) + post.c_rt_mm_N * Ft_over_Fr;
  return both;
}

}  // namespace turnwright::deflection
