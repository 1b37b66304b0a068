#include "held_tube.hpp"

#include <algorithm>
#include <limits>

#include "jaws.hpp"
#include "turnwright/deflection/ring.hpp"

namespace turnwright::planning {

double HeldTube::decay_1_mm() const {
  return deflection::lobe_decay_1_mm(R_mm(), wall_mm(), kJaws);
}

double HeldTube::width_mm(double grip_mm) const {
  return std::max(grip_mm, 1 / (2 * decay_1_mm()));
}

HeldTube held_tube(const PreparedPart& p, std::size_t setup, Clamping clamping) {
  return {grip_diameter_mm(p, setup, clamping), gripped_bore_mm(p, setup)};
}

double squeeze_MPa(const PreparedPart& p, std::size_t setup, Clamping clamping,
                   double force_N) {
  const auto tube = held_tube(p, setup, clamping);
  if (!tube.hollow()) return 0;
  return deflection::squeezed_wall(tube.inner_mm, tube.outer_mm,
                                   tube.width_mm(p.grips_mm[setup]), kJaws,
                                   force_N / kJaws)
      .largest_MPa();
}

double elastic_grip_N(const PreparedPart& p, std::size_t setup, Clamping clamping) {
  const double of_1N = squeeze_MPa(p, setup, clamping, 1);
  if (!(of_1N > 0) || !p.material.yield_MPa || p.setups[setup].jaws == Jaws::collet)
    return std::numeric_limits<double>::infinity();
  return kOfYield * *p.material.yield_MPa / of_1N;
}

}  // namespace turnwright::planning
