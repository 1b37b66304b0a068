#include "step_axis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "turnwright/base/errors.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::exchange {
namespace {

constexpr std::size_t kMostAxes = 500;  // holes of a bolt circle, pins, keyways' ends

bool turns(const Surface& s) {
  using enum Surface::Kind;
  return s.kind == cylinder || s.kind == cone || s.kind == torus;
}

/// About the part of the surface that the face covers [mm2], from the length of its
/// boundary along the axis and the share of a turn in its circles: good enough to compare.
double area_mm2(const Face& face, const Axis& axis) {
  double from = std::numeric_limits<double>::infinity(), to = -from;
  double r = 0, turn = 0;
  for (const auto& b : face.boundary) {
    const auto p = axis.point(b.from);
    from = std::min(from, p.z_mm), to = std::max(to, p.z_mm), r = std::max(r, p.r_mm);
    if (b.kind == Boundary::Kind::circle && axis.parallel(b.normal)) turn += b.turn_rad();
  }
  return from < to ? (to - from) * r * turn / 2 : 0;
}

struct Candidate {
  Axis axis;
  double area_mm2 = 0, largest_mm2 = -1;
};

}  // namespace

bool coaxial(const Surface& s, const Axis& axis) {
  if (s.kind == Surface::Kind::other) return false;
  if (s.kind == Surface::Kind::plane) return axis.parallel(s.axis);
  return axis.r_mm(s.origin) < kSame_mm &&
         (s.kind == Surface::Kind::sphere || axis.parallel(s.axis));
}

Axis turning_axis(const std::vector<Face>& faces) {
  std::vector<Candidate> all;
  for (const auto& f : faces) {
    if (!turns(f.surface)) continue;
    const auto same = std::find_if(all.begin(), all.end(), [&f](const Candidate& c) {
      return coaxial(f.surface, c.axis);
    });
    if (same == all.end() && all.size() == kMostAxes)
      throw InputError("STEP file", {{"", tr("faces about more than 500 axes"),
                                      tr("a turned part"), "not-turned"}});
    auto& c = same == all.end() ? all.emplace_back() : *same;
    const Axis own{f.surface.origin, f.surface.axis};
    const double area = area_mm2(f, own);
    c.area_mm2 += area;
    if (area > c.largest_mm2) c.largest_mm2 = area, c.axis = own;
  }
  if (all.empty())
    throw InputError("STEP file",
                     {{"", tr("a body without a cylinder, a cone or a torus"),
                       tr("a turned part"), "not-turned"}});
  auto axis = std::max_element(all.begin(), all.end(),
                               [](const Candidate& a, const Candidate& b) {
                                 return a.area_mm2 < b.area_mm2;
                               })
                  ->axis;
  for (const double x : axis.direction) {
    if (std::abs(x) < kParallel_rad) continue;
    if (x < 0) axis.direction = -axis.direction;
    break;
  }
  axis.origin -= axis.direction * axis.direction.dot(axis.origin);
  return axis;
}

}  // namespace turnwright::exchange
