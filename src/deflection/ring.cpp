#include "turnwright/deflection/ring.hpp"

#include <cmath>
#include <stdexcept>

#include "turnwright/base/units.hpp"

namespace turnwright::deflection {

double wall_EI_Nmm2(double E_MPa, double width_mm, double wall_mm) {
  if (!(E_MPa > 0 && width_mm > 0 && wall_mm > 0))
    throw std::domain_error("wall_EI: E, width and wall must be > 0");
  return E_MPa * width_mm * wall_mm * wall_mm * wall_mm / 12;
}

double squeeze_mm(const Ring& ring, int jaws, double jaw_force_N, double angle_rad) {
  const double R = ring.R_mm, EI = ring.EI_Nmm2, F = jaw_force_N;
  if (!(R > 0 && EI > 0 && jaws >= 2 && std::isfinite(F) && std::isfinite(angle_rad)))
    throw std::domain_error("squeeze: R and EI must be > 0, at least two jaws");
  const double alpha = units::kPi / jaws;
  const double sin_a = std::sin(alpha), cos_a = std::cos(alpha);
  // remainder lies within alpha of a jaw; the middle is alpha away
  const double phi = alpha - std::abs(std::remainder(angle_rad, 2 * alpha));
  return F * R * R * R / (2 * EI) *  // Eq. (2)
         (phi * std::sin(phi) / (2 * sin_a) - 1 / alpha +
          std::cos(phi) * (sin_a + alpha * cos_a) / (2 * sin_a * sin_a));
}

double lobing_mm(const Ring& ring, int jaws, double jaw_force_N) {
  return std::abs(squeeze_mm(ring, jaws, jaw_force_N, 0) -
                  squeeze_mm(ring, jaws, jaw_force_N, units::kPi / jaws));
}

Ring with_shear(const Ring& ring, double wall_mm) {
  const double thickness = wall_mm / ring.R_mm;
  return {ring.R_mm, ring.EI_Nmm2 / (1 + 2.3 * thickness * thickness)};
}

WallStress bent_wall(double inner_mm, double outer_mm, double width_mm, double M_Nmm) {
  const double ri = inner_mm / 2, ro = outer_mm / 2, t = ro - ri;
  if (!(ri > 0 && t > 0 && width_mm > 0 && std::isfinite(M_Nmm)))
    throw std::domain_error("bent_wall: inner, wall and width must be > 0");
  const double rn = t / std::log(ro / ri), e = (ro + ri) / 2 - rn;
  const double unit = M_Nmm / (width_mm * t * e);  // Eq. (4)
  return {unit * (rn - ri) / ri, unit * (rn - ro) / ro};
}

WallStress squeezed_wall(double inner_mm, double outer_mm, double width_mm, int jaws,
                         double jaw_force_N) {
  if (!(jaws >= 2)) throw std::domain_error("squeezed_wall: at least two jaws");
  const double alpha = units::kPi / jaws, R = (inner_mm + outer_mm) / 4;
  const auto at = [&](double couple, double thrust) {  // of F R/2 and F/2; Eq. (5)
    auto s = bent_wall(inner_mm, outer_mm, width_mm, jaw_force_N * R / 2 * couple);
    const double pressed =
        jaw_force_N / 2 * thrust / (width_mm * (outer_mm - inner_mm) / 2);
    return WallStress{s.inner_MPa - pressed, s.outer_MPa - pressed};
  };
  const auto jaw = at(1 / alpha - 1 / std::tan(alpha), 1 / std::tan(alpha));
  const auto middle = at(1 / alpha - 1 / std::sin(alpha), 1 / std::sin(alpha));
  return jaw.largest_MPa() >= middle.largest_MPa() ? jaw : middle;
}

double lobe_decay_1_mm(double R_mm, double wall_mm, int jaws) {
  if (!(R_mm > 0 && wall_mm > 0 && jaws >= 2))
    throw std::domain_error("lobe_decay: R and wall must be > 0, at least two jaws");
  const double n2 = jaws * jaws;
  return std::sqrt(n2 * (n2 - 1) * wall_mm / (std::sqrt(48.0) * R_mm)) / R_mm;  // Eq. (3)
}

}  // namespace turnwright::deflection
