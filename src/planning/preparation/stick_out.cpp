#include "stick_out.hpp"

#include <algorithm>
#include <cmath>

#include "planning/paths/approach.hpp"

namespace turnwright::planning {
namespace {

constexpr double kStep_mm = 5;

// From the free face to the inner end of a bore, and the narrowest hole on the way.
struct WayIn {
  double depth_mm = 0, least_mm = INFINITY;
};
WayIn way_into(const part::Drawing& d, std::size_t bore) {
  WayIn way;
  for (std::size_t i = 0; i <= bore; ++i) {
    const auto& e = d.inner[i];
    if (e.from != d.inner[bore].from) continue;
    way.depth_mm += e.length_mm;
    way.least_mm = std::min({way.least_mm, e.left_mm, e.right_mm});
  }
  return way;
}

// Eq. (1); 0 if it reaches no bore.
double wanted_mm(const part::Drawing& d, const catalogue::BoringBar& bar) {
  double most = 0;
  for (std::size_t i = 0; i < d.inner.size(); ++i) {
    const auto way = way_into(d, i);
    const double needed = std::ceil((way.depth_mm + kBefore_mm) / kStep_mm) * kStep_mm;
    if (way.least_mm >= bar.min_bore_mm && needed <= *bar.longest_mm)
      most = std::max(most, needed);
  }
  return most;
}

}  // namespace

void set_stick_outs(PreparedPart& p) {
  for (auto& t : p.tools) {
    if (!t.bar || !t.bar->longest_mm) continue;
    const double wanted = wanted_mm(p.drawing, *t.bar);
    if (!(wanted > 0)) continue;
    auto& shank = t.bar->segments.front();
    const double head = catalogue::stick_out_mm(*t.bar) - shank.length_mm;
    shank.length_mm = std::max(wanted - head, shank.diameter_mm);
  }
}

}  // namespace turnwright::planning
