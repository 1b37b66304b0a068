#include "turnwright/deflection/face.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace turnwright::deflection {

FaceForm face_form(const Flexibility& radial, const Facing& facing) {
  const double low = facing.rho_min_mm, high = facing.rho_max_mm;
  if (!(low >= 0 && low < high && std::isfinite(high)))
    throw std::domain_error("face_form: radii must be 0 <= rho_min < rho_max");
  const double first = -radial.f_wp_rad_N * facing.Ff_N;
  const double second = radial.f_pp_rad_Nmm * facing.Fp_N;
  constexpr int kSteps = 32;
  FaceForm form;
  for (int k = 0; k <= kSteps; ++k)
    form.rho_mm.push_back(std::lerp(low, high, static_cast<double>(k) / kSteps));
  const double vertex = -first / (2 * second);
  if (vertex > low && vertex < high)
    form.rho_mm.insert(std::lower_bound(form.rho_mm.begin(), form.rho_mm.end(), vertex),
                       vertex);
  for (const double rho : form.rho_mm)
    form.g_mm.push_back((first + second * rho) * rho);  // Eq. (1)
  const auto [lowest, highest] = std::minmax_element(form.g_mm.begin(), form.g_mm.end());
  form.peak_to_valley_mm = *highest - *lowest;
  return form;
}

}  // namespace turnwright::deflection
