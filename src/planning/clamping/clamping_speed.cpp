#include "clamping_speed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "turnwright/base/units.hpp"
#include "turnwright/cutting/spindle.hpp"

namespace turnwright::planning {

double clamping_rpm(const PreparedPart& p, Clamping clamping) {
  const auto& m = p.machine;
  if (clamping == Clamping::between_centres) return m.n_max_rpm;
  return std::min(m.n_max_rpm, m.chuck.n_max_rpm);
}

double grip_loss_rpm(const PreparedPart& p, Clamping clamping, double force_N) {
  const auto& c = p.machine.chuck;
  if (clamping == Clamping::between_centres || !(c.jaw_mass_radius_kg_m > 0))
    return std::numeric_limits<double>::infinity();
  return std::sqrt(cutting::kGripLoss * force_N / c.jaw_mass_radius_kg_m) * 30 /
         units::kPi;
}

}  // namespace turnwright::planning
