#include "common_datum.hpp"

#include <stdexcept>

namespace turnwright::planning {

double middle_z_mm(const part::Drawing& drawing, const std::string& element) {
  const auto at = part::extent(drawing, element);
  if (!at) throw std::domain_error("middle_z_mm: no element " + element);
  return (at->z0_mm + at->z1_mm) / 2;
}

DatumWeights datum_weights(const part::Drawing& drawing, const part::Tolerance& t,
                           double z_mm) {
  if (t.common_datum.empty()) return {};
  const double a = middle_z_mm(drawing, t.datum),
               b = middle_z_mm(drawing, t.common_datum);
  const double w = (z_mm - a) / (b - a);  // Eq. (1)
  return {1 - w, w};
}

volumetric::DatumAxis axis_through(double z_a_mm, const Across& a, double z_b_mm,
                                   const Across& b) {
  if (z_a_mm == z_b_mm) throw std::domain_error("axis_through: two places are wanted");
  const double ax = (b.x_mm - a.x_mm) / (z_b_mm - z_a_mm),  // Eq. (2)
      ay = (b.y_mm - a.y_mm) / (z_b_mm - z_a_mm);
  return {
      .x0_mm = a.x_mm - ax * z_a_mm, .y0_mm = a.y_mm - ay * z_a_mm, .ax = ax, .ay = ay};
}

}  // namespace turnwright::planning
