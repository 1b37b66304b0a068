#include "jaws.hpp"

#include <algorithm>

#include "positions.hpp"

namespace turnwright::planning {

double grip_diameter_mm(const PreparedPart& p, std::size_t s, Clamping clamping) {
  if (clamping == Clamping::between_centres) return 0;
  // The smallest diameter between the jaws.
  const double jaws = jaws_z_mm(p, s), far = 1e9;
  double d = holds_left(p, s) ? part::stock_between(p.drawing.stock, -far, jaws).least_mm
                              : part::stock_between(p.drawing.stock, jaws, far).least_mm;
  if (s == 0) return d;
  const auto& e = p.drawing.outer;
  for (std::size_t i = 0; i < e.size(); ++i) {
    const double z0 = part::left_z_mm(p.drawing, i), z1 = z0 + e[i].length_mm;
    if (holds_left(p, s) ? z0 < jaws - 1e-9 : z1 > jaws + 1e-9)
      d = std::min({d, e[i].left_mm, e[i].right_mm});
  }
  return d;
}

double gripped_bore_mm(const PreparedPart& p, std::size_t s) {
  const auto& d = p.drawing;
  double bore = d.stock.inner_mm;
  for (std::size_t k = 0; k <= s; ++k)
    for (const std::size_t i : p.work.setups[k].bores) {
      const double z0 = part::inner_left_z_mm(d, i), z1 = z0 + d.inner[i].length_mm;
      if (holds_left(p, s) ? z0 < jaws_z_mm(p, s) : z1 > jaws_z_mm(p, s))
        bore = std::max({bore, d.inner[i].left_mm, d.inner[i].right_mm});
    }
  return bore;
}

double jaw_force_N(const PreparedPart& p, std::size_t s, Clamping clamping, Stage stage) {
  if (clamping == Clamping::between_centres) return 0;
  return stage == Stage::roughing ? p.jaws.at(s).roughing_N : p.jaws.at(s).finishing_N;
}

}  // namespace turnwright::planning
