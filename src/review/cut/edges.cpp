#include "edges.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "turnwright/part/cut.hpp"

namespace turnwright::review {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kChord_mm = 1e-5;        // of corners that cut
constexpr double kOthersChord_mm = 1e-3;  // and of the insert's other corners
constexpr double kProfilingKapr_rad = 93 * kPi / 180;
constexpr double kProfilingEdge_mm = 12;
constexpr double kFar_mm = 1000;

// A corner between two edges of a length.
Polygon wedge(double re, double kapr_rad, double minor_rad, double length) {
  const double eps = kPi - kapr_rad - minor_rad;
  const catalogue::OutlinePoint major{std::sin(kapr_rad), -std::cos(kapr_rad)},
      minor{std::sin(minor_rad), std::cos(minor_rad)};
  const double back = re / std::sin(eps);
  const catalogue::OutlinePoint corner{re - back * (major.h_mm + minor.h_mm),
                                       re - back * (major.z_mm + minor.z_mm)};
  const auto on = [&](const catalogue::OutlinePoint& edge) {
    return catalogue::OutlinePoint{corner.h_mm + length * edge.h_mm,
                                   corner.z_mm + length * edge.z_mm};
  };
  return insert_edge({re, {corner, on(major), on(minor)}, {}});
}

}  // namespace

Polygon polygon_of(const catalogue::ConvexOutline& outline) {
  Polygon all;
  for (const auto& p : outline) all.push_back({p.h_mm, p.z_mm});
  return hull(std::move(all));
}

Polygon rectangle(double x0, double x1, double z0, double z1) {
  return hull({{x0, z0}, {x0, z1}, {x1, z1}, {x1, z0}});
}

Polygon insert_edge(const catalogue::ToolOutline& outline) {
  const double r = outline.re_mm;
  const auto cuts = [&](const catalogue::OutlinePoint& p) {
    return std::hypot(p.h_mm - r, p.z_mm - r) < r + 1e-9;
  };
  catalogue::ConvexOutline all;
  for (const auto& p : catalogue::rounded_insert(outline, kChord_mm))
    if (cuts(p)) all.push_back(p);
  for (const auto& p : catalogue::rounded_insert(outline, kOthersChord_mm))
    if (!cuts(p)) all.push_back(p);
  return polygon_of(all);
}

Polygon profiling_edge(double re_mm) {
  return wedge(re_mm, kProfilingKapr_rad, part::kProfilingClears_rad, kProfilingEdge_mm);
}

Polygon pointed_edge(double D, double point) {
  const double r = D / 2;
  return hull({{0, 0}, {r, point}, {r, kFar_mm}, {-r, kFar_mm}, {-r, point}});
}

Polygon thread_edge(double pitch_mm) {
  const double h = 0.8 * pitch_mm, w = h * std::tan(kPi / 6);
  return hull({{0, 0}, {h, w}, {h, -w}});
}

}  // namespace turnwright::review
