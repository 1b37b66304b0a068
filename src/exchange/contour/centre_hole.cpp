#include "centre_hole.hpp"

#include <algorithm>
#include <cmath>

#include "elements.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::exchange {
namespace {

constexpr double kHalf_rad = units::kPi / 6;       // half the 60 deg of a centre
constexpr double kProtected_rad = units::kPi / 3;  // half the 120 deg of form B
constexpr double kAngle_rad = 0.01;
constexpr double kSharpest_rad = units::kPi / 4;  // half the point of a drill

// One side of a bore on the way in.
struct Step {
  double before_mm = 0, behind_mm = 0;  // radii
  double along_mm = 0;
  const Side* side = nullptr;
};

std::vector<Step> inwards(const std::vector<Side>& sides, part::End from) {
  std::vector<Step> steps;
  for (const Side& s : sides)
    steps.push_back({s.from.r_mm, s.to.r_mm, std::abs(s.to.z_mm - s.from.z_mm), &s});
  if (from == part::End::left) {
    std::reverse(steps.begin(), steps.end());
    for (Step& s : steps) std::swap(s.before_mm, s.behind_mm);
  }
  return steps;
}

// Angle from the axis at which a straight side narrows.
double narrows_rad(const Step& s) {
  return std::atan2(s.before_mm - s.behind_mm, s.along_mm);
}

bool is_cone(const Step& s, double angle_rad) {
  return !s.side->centre && std::abs(narrows_rad(s) - angle_rad) < kAngle_rad;
}

// Where a centre of 60 deg touches an arc the radius stands upright on its flank, from
// outside: no arc about a centre within the hole has such a place.
bool carries_centre(const Step& s) {
  if (!s.side->centre) return false;
  const Point& c = *s.side->centre;
  const double R = std::hypot(s.side->from.z_mm - c.z_mm, s.side->from.r_mm - c.r_mm);
  const double touches_mm = c.r_mm - R * std::cos(kHalf_rad);
  return s.behind_mm < touches_mm && touches_mm < s.before_mm;
}

bool is_pilot(const Step& s, double join_mm) {
  return !s.side->centre && s.along_mm > join_mm &&
         std::abs(s.before_mm - s.behind_mm) <= join_mm;
}

bool is_bottom(const Step& s, double join_mm) {
  return !s.side->centre && s.behind_mm <= join_mm && narrows_rad(s) > kSharpest_rad;
}

// As the table of ISO 6411 gives its sizes.
double hundredths(double mm) { return std::round(100 * mm) / 100; }

bool is_shallow(const std::vector<Side>& sides) {
  constexpr double kDeepest = 1.5;  // depth over the mouth's width
  double mouth_mm = 0, z0 = sides.front().from.z_mm, z1 = z0;
  for (const Side& s : sides) {
    mouth_mm = std::max({mouth_mm, 2 * s.from.r_mm, 2 * s.to.r_mm});
    z0 = std::min({z0, s.from.z_mm, s.to.z_mm});
    z1 = std::max({z1, s.from.z_mm, s.to.z_mm});
  }
  return z1 - z0 <= kDeepest * mouth_mm;
}

}  // namespace

std::optional<part::CentreHole> centre_hole_of(const std::vector<Side>& sides,
                                               part::End from, double join_mm) {
  const auto steps = inwards(sides, from);
  constexpr std::size_t kBehindSeat = 2;  // the pilot and its bottom
  const bool b = !steps.empty() && is_cone(steps.front(), kProtected_rad);
  const std::size_t seat = b ? 1 : 0;
  if (steps.size() != seat + 1 + kBehindSeat || !is_shallow(sides)) return std::nullopt;
  const bool a = is_cone(steps[seat], kHalf_rad), r = !b && carries_centre(steps[seat]);
  const Step &pilot = steps[seat + 1], &bottom = steps[seat + 2];
  if (!(a || r) || !is_pilot(pilot, join_mm) || !is_bottom(bottom, join_mm))
    return std::nullopt;
  return part::centre_hole(b ? 'B' : (a ? 'A' : 'R'), hundredths(2 * pilot.before_mm),
                           hundredths(2 * steps.front().before_mm));
}

bool like_centre_hole(const std::vector<Side>& sides, double join_mm) {
  constexpr std::size_t kMost = 5;  // sides, with the point of the drill
  constexpr double kLargest_mm = 12.5;
  if (sides.size() < 2 || sides.size() > kMost || !is_shallow(sides)) return false;
  const bool blind =
      on_axis(sides.front().from, join_mm) || on_axis(sides.back().to, join_mm);
  return blind && std::any_of(sides.begin(), sides.end(), [&](const Side& s) {
           const double r0 = std::min(s.from.r_mm, s.to.r_mm),
                        r1 = std::max(s.from.r_mm, s.to.r_mm);
           const double angle = std::atan2(r1 - r0, std::abs(s.to.z_mm - s.from.z_mm));
           return !s.centre && r0 > join_mm && r0 <= r1 / 2 && 2 * r0 <= kLargest_mm &&
                  std::abs(angle - kHalf_rad) < kAngle_rad;
         });
}

}  // namespace turnwright::exchange
