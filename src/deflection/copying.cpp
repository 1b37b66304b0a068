#include "turnwright/deflection/copying.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace turnwright::deflection {

std::vector<double> copied_runout_of_passes(double D_mm, const Flexibility& radial,
                                            const Flexibility& tangential,
                                            const ForceLaw& law, double runout_mm,
                                            std::span<const double> ap_mm) {
  if (!(runout_mm >= 0 && !ap_mm.empty() && runout_mm < ap_mm.front()))
    throw std::domain_error("copied_runout: the run-out must be in [0, first depth)");
  // The high and the low side of the blank are two passes in a row of their own.
  const auto side = [&](double by_mm) {
    std::vector<double> depths(ap_mm.begin(), ap_mm.end());
    depths.front() += by_mm;
    return radius_errors_of_passes(D_mm, radial, tangential, law, depths);
  };
  const std::vector<double> high = side(runout_mm), low = side(-runout_mm);
  std::vector<double> left;
  for (std::size_t i = 0; i < high.size(); ++i)
    left.push_back((high[i] - low[i]) / 2);  // Eq. (1)
  return left;
}

}  // namespace turnwright::deflection
