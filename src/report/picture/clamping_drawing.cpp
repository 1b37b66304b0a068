#include "clamping_drawing.hpp"

#include <algorithm>

namespace turnwright::report {
namespace {

using part::End;
using planning::Clamping;

constexpr double kCentreShank = 6, kTan30 = 0.57735026918962576;  // paper mm; a ratio

/// What jaws hold: the part, beyond it the bar that it is parted off.
Runs held_between(const SetupView& s, double from_z, double to_z) {
  const auto bar = [&](double a, double b) {
    return part::stock_between(s.part.drawing.stock, a, b).most_mm / 2;
  };
  Runs all = s.contour.outer;
  if (const double z = s.left_z(); from_z < z)
    all.insert(all.begin(), {from_z, z, bar(from_z, z), bar(from_z, z)});
  if (const double z = s.right_z(); to_z > z)
    all.push_back({z, to_z, bar(z, to_z), bar(z, to_z)});
  return between(all, from_z, to_z);
}

/// Jaws bored to the part: they touch it over the whole grip.
void draw_jaws(SetupView& s) {
  const double end = planning::root_z_mm(s.part, s.setup, s.clamping());
  const double grip = s.part.grips_mm[s.setup];
  const double outward = s.holds_left() ? end - grip : end + grip;
  const Runs held = held_between(s, std::min(end, outward), std::max(end, outward));
  double top = 0;
  for (const Run& run : held) top = std::max({top, run.r0, run.r1});
  top += SetupView::kJaw / s.scale.length;
  for (const double side : {1.0, -1.0}) {
    std::vector<Point> jaw;
    for (const Run& run : held) {
      jaw.push_back(s.at(run.z0, side * run.r0));
      jaw.push_back(s.at(run.z1, side * run.r1));
    }
    jaw.push_back(s.at(held.back().z1, side * top));
    jaw.push_back(s.at(held.front().z0, side * top));
    s.svg.polygon("jaw", jaw);
  }
}

/// Where its rollers run, narrower towards the part.
void draw_steady_rest(SetupView& s) {
  const double z = s.part.setups[s.setup].steady_z_mm;
  const double half = planning::kSteadyWidth_mm / 2;
  double r = 0;
  for (const Run& run : between(s.contour.outer, z - half, z + half))
    r = std::max({r, run.r0, run.r1});
  const double top = r + SetupView::kJaw / s.scale.length;
  for (const double side : {1.0, -1.0})
    s.svg.polygon("rest", {s.at(z - half / 2, side * r), s.at(z + half / 2, side * r),
                           s.at(z + half, side * top), s.at(z - half, side * top)});
}

/// A 60 degree point in the part's end: as deep as the bore lets it, or a centre hole.
void draw_centre(SetupView& s, End end) {
  const double out = end == s.held() ? -1 : 1;
  const double bore =
      end == End::left ? s.contour.inner.front().r0 : s.contour.inner.back().r1;
  const double depth = std::max(1.5, s.scale.length * bore / kTan30);
  const Point face = s.at(end == End::left ? s.left_z() : s.right_z(), 0);
  const double base = face.x + out * 3, half = (depth + 3) * kTan30;
  s.svg.polygon("centre", {{face.x - out * depth, s.axis},
                           {base, s.axis - half},
                           {base + out * kCentreShank, s.axis - half},
                           {base + out * kCentreShank, s.axis + half},
                           {base, s.axis + half}});
}

}  // namespace

void draw_clamping(SetupView& s) {
  const End held = s.held(), free = part::opposite(held);
  if (s.clamping() == Clamping::between_centres)
    draw_centre(s, held);
  else
    draw_jaws(s);
  if (s.clamping() == Clamping::chuck_steady)
    draw_steady_rest(s);
  else if (s.clamping() != Clamping::chuck)
    draw_centre(s, free);
}

}  // namespace turnwright::report
