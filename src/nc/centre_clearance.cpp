#include "centre_clearance.hpp"

#include <algorithm>
#include <cmath>

#include "base/say.hpp"
#include "planning/clamping/centre_clearance.hpp"

namespace turnwright::nc {
namespace {

constexpr double kStep_mm = 0.5;
constexpr double kRounding_mm = 1e-6;

// By how much a move comes too near to the centre.
double too_low_mm(const Site& site, const catalogue::Tool& tool, const Point& a,
                  const Point& b) {
  const int n =
      std::max(1, static_cast<int>(std::ceil(std::abs(b.z_mm - a.z_mm) / kStep_mm)));
  double worst = 0;
  for (int i = 0; i < n; ++i) {
    const double s = double(i) / n, t = double(i + 1) / n;
    const double x = std::min(std::lerp(a.h_mm, b.h_mm, s), std::lerp(a.h_mm, b.h_mm, t));
    const double z = std::max(std::lerp(a.z_mm, b.z_mm, s), std::lerp(a.z_mm, b.z_mm, t));
    worst =
        std::max(worst, planning::clear_of_centre_mm(site.part, site.setup, tool, z) - x);
  }
  return worst;
}

}  // namespace

void keep_clear_of_centre(Site& site, const planning::OperationPlan& o, Point from) {
  const auto& tools = site.part.tools;
  const auto tool = std::ranges::find(tools, o.tool, &catalogue::Tool::id);
  if (tool == tools.end()) return;
  double worst = 0;
  for (const auto& m : site.moves) {
    const Point to{m.x_mm, m.z_mm};
    worst = std::max(worst, too_low_mm(site, *tool, from, to));
    from = to;
  }
  if (worst > kRounding_mm)
    site.refuse(o.id, say("{} would meet the live centre by {:.2g} mm", o.tool, worst));
}

}  // namespace turnwright::nc
