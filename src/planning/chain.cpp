#include "chain.hpp"

#include <algorithm>

namespace turnwright::planning {

double yielding_mm(const Law& law, const cutting::Cut& cut, double a, double ap, double f,
                   double e_before) {
  const double full = ap + e_before;
  // G(e) = e - law(full - e) rises (the force grows with the depth), is <= 0 at the lower
  // and >= 0 at the upper end; near full depth nothing is cut, so e stays below it.
  const auto G = [&](double e) {
    const auto l = detail::along_depth(law, cut, a, std::max(full - e, 1e-9 * full), f);
    return std::pair{e - l.v, 1 + l.d[0]};
  };
  const double first = -G(0).first;
  const double lower = std::min(0.0, 2 * first),
               upper = first > 0 ? std::min(first, full) : 0;
  if (lower == upper) return 0;
  std::uintmax_t steps = 50;
  return boost::math::tools::newton_raphson_iterate(
      G, first / (1 + std::max(0.0, G(0).second - 1)), lower, upper, 52, steps);
}

}  // namespace turnwright::planning
