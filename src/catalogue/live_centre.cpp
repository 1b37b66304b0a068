#include "turnwright/catalogue/live_centre.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "turnwright/catalogue/tool_outline.hpp"

namespace turnwright::catalogue {
namespace {

constexpr double kNowhere_mm = std::numeric_limits<double>::infinity();

// The centre in front of the free face by Eq. (1).
struct Profile {
  double hole_mm, point_mm, body_mm;  // radii
  double cylinder_z, body_z;

  double radius_mm(double z) const {
    if (z < 0) return -kNowhere_mm;  // in the part, which the tool clears anyway
    if (z >= body_z) return body_mm;
    return std::min(point_mm, hole_mm + z * std::numbers::inv_sqrt3);
  }
};

Profile profile(const LiveCentre& c, double hole_mm) {
  const double hole = hole_mm / 2, point = std::max(c.point_mm, hole_mm) / 2;
  return {hole, point, std::max(c.body_mm, hole_mm) / 2,
          (point - hole) * std::numbers::sqrt3,
          c.point_length_mm - std::min(hole_mm, c.point_mm) / 2 * std::numbers::sqrt3};
}

// Height of the lowest point of a convex outline at a place on its axis.
double lowest_mm(const ConvexOutline& all, double z) {
  double low = kNowhere_mm;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto &a = all[i], &b = all[(i + 1) % all.size()];
    if (z < std::min(a.z_mm, b.z_mm) || z > std::max(a.z_mm, b.z_mm)) continue;
    const double t = a.z_mm == b.z_mm ? 0 : (z - a.z_mm) / (b.z_mm - a.z_mm);
    low = std::min({low, std::lerp(a.h_mm, b.h_mm, t), a.z_mm == b.z_mm ? b.h_mm : low});
  }
  return low;
}

double clear_mm(const ConvexOutline& piece, const Profile& centre, double z_mm) {
  double least = 0;
  const auto at = [&](double z) {
    least = std::max(least, centre.radius_mm(z) - lowest_mm(piece, z - z_mm));
  };
  for (const auto& p : piece)
    least = std::max(least, centre.radius_mm(p.z_mm + z_mm) - p.h_mm);
  for (const double z : {0.0, centre.cylinder_z, centre.body_z}) at(z);
  return least;
}

}  // namespace

double clear_radius_mm(const Tool& tool, const LiveCentre& c, double hole_mm,
                       double z_mm) {
  const auto all = outline(tool);
  const auto centre = profile(c, hole_mm);
  double least = clear_mm(all.insert, centre, z_mm);
  for (const auto& piece : all.holder)
    least = std::max(least, clear_mm(piece, centre, z_mm));
  return least;
}

}  // namespace turnwright::catalogue
