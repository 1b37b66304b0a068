#include "samples.hpp"

#include <algorithm>
#include <cmath>

#include "quadrature.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::chatter {

std::vector<Sample> samples(const System& system, double n_rpm,
                            const std::vector<Arc>& arcs, double from_s, double to_s) {
  constexpr std::size_t kNodes = 12;
  constexpr double kPower = 4;
  const Quadrature& rule = quadrature(kNodes);
  const double rad_s = 2 * units::kPi * n_rpm / 60, start = arcs.front().begin_rad;
  std::vector<Sample> out;
  for (const Arc& arc : arcs) {
    if (arc.offsets_rad.empty()) continue;
    const double begin = (arc.begin_rad - start) / rad_s,
                 end = (arc.end_rad - start) / rad_s;
    const double from = std::max(begin, from_s), to = std::min(end, to_s);
    if (!(to > from)) continue;
    // Halves, so that each has at most one root end.
    for (const bool first : {true, false}) {
      const double half = (to - from) / 2, a = first ? from : from + half;
      const bool graded = first ? arc.root_at_begin : arc.root_at_end;
      for (std::size_t i = 0; i < kNodes; ++i) {
        const double s = first ? rule.nodes[i] : 1 - rule.nodes[i];
        const double share = graded ? std::pow(s, kPower) : s;
        const double slope = graded ? kPower * std::pow(s, kPower - 1) : 1;
        const double t = first ? a + half * share : a + half * (1 - share);
        out.push_back({.t_s = t,
                       .weight_s = half * rule.weights[i] * slope,
                       .h = directional_MPa(system, n_rpm, arc, start + t * rad_s)});
      }
    }
  }
  return out;
}

}  // namespace turnwright::chatter
