#include "turnwright/catalogue/tool_outline.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "turnwright/base/units.hpp"

namespace turnwright::catalogue {
namespace {

OutlinePoint operator+(const OutlinePoint& a, const OutlinePoint& b) {
  return {a.h_mm + b.h_mm, a.z_mm + b.z_mm};
}
OutlinePoint operator-(const OutlinePoint& a, const OutlinePoint& b) {
  return {a.h_mm - b.h_mm, a.z_mm - b.z_mm};
}
OutlinePoint operator*(double k, const OutlinePoint& a) {
  return {k * a.h_mm, k * a.z_mm};
}
double dot(const OutlinePoint& a, const OutlinePoint& b) {
  return a.h_mm * b.h_mm + a.z_mm * b.z_mm;
}

// A side that is turned by an angle from -z over h, and the normal to its right, which
// points into a clockwise polygon.
OutlinePoint along(double kappa) {
  return {std::sin(kappa), -std::cos(kappa)};  // Eq. (1)
}
OutlinePoint inward(double kappa) { return {std::cos(kappa), std::sin(kappa)}; }

// Angles [deg] of the corners, the cutting one first.
std::vector<double> corners_deg(const Insert1832& insert) {
  const double eps = insert.included_angle_deg;
  switch (insert.shape) {
    case 'R':
      return {};
    case 'W':
      return {80, 160, 80, 160, 80, 160};
    case 'T':
    case 'S':
    case 'P':
    case 'H':
    case 'O':
      return std::vector<double>(static_cast<std::size_t>(std::lround(360 / (180 - eps))),
                                 eps);
    default:
      return {eps, 180 - eps, eps, 180 - eps};
  }
}

// Where the centre of a corner's arc lies, seen from the sharp corner between two sides.
OutlinePoint to_centre(double re, double kappa_in, double kappa_out) {
  const auto m = inward(kappa_in), n = inward(kappa_out);
  return re / (1 + dot(m, n)) * (m + n);
}

ConvexOutline insert_polygon(const Insert1832& insert, double kapr_deg, double re) {
  const auto corners = corners_deg(insert);
  if (corners.empty()) return {};
  double kappa = units::rad_from_deg(kapr_deg);
  const double before = kappa - units::rad_from_deg(180 - corners[0]);
  ConvexOutline all{OutlinePoint{re, re} - to_centre(re, before, kappa)};
  for (std::size_t i = 1; i < corners.size(); ++i) {
    all.push_back(all.back() + insert.edge_length_mm * along(kappa));
    kappa += units::rad_from_deg(180 - corners[i]);
  }
  return all;
}

// The line of an edge: a point, and its direction.
struct Edge {
  OutlinePoint on;
  double kappa = 0;
};

// The part of a polygon that the seat of an insert leaves behind an edge.
ConvexOutline behind(const ConvexOutline& polygon, const Edge& edge) {
  const auto depth = [&](const OutlinePoint& p) {
    return dot(p - edge.on, inward(edge.kappa)) - kSeatBehind_mm;
  };
  ConvexOutline kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double da = depth(a), db = depth(b);
    if (da >= 0) kept.push_back(a);
    if ((da > 0 && db < 0) || (da < 0 && db > 0))
      kept.push_back(a + da / (da - db) * (b - a));
  }
  return kept;
}

ConvexOutline rectangle(const Range& h, const Range& z) {
  return {{h.lower, z.lower}, {h.upper, z.lower}, {h.upper, z.upper}, {h.lower, z.upper}};
}

std::vector<ConvexOutline> external(const Holder& holder, const Edge& major,
                                    const Edge& minor) {
  const Range width{holder.wf_mm - holder.b_mm, holder.wf_mm};
  auto head = rectangle({0, holder.lh_mm}, {std::min(width.lower, 0.0), width.upper});
  for (const auto& edge : {major, minor}) head = behind(head, edge);
  std::vector<ConvexOutline> all{rectangle({holder.lh_mm, holder.lf_mm}, width)};
  if (head.size() > 2) all.push_back(head);
  return all;
}

std::vector<ConvexOutline> bar_outlines(const BoringBar& bar, const Edge& major) {
  std::vector<ConvexOutline> all;
  double z = 0;
  for (auto s = bar.segments.rbegin(); s != bar.segments.rend(); ++s) {
    const double r = s->diameter_mm / 2;
    const auto piece = behind(
        rectangle({bar.tip_offset_mm - r, bar.tip_offset_mm + r}, {z, z + s->length_mm}),
        major);
    if (piece.size() > 2) all.push_back(piece);
    z += s->length_mm;
  }
  return all;
}

}  // namespace

std::optional<double> minor_angle_deg(double kapr_deg, const Insert1832& insert) {
  if (insert.shape == 'R') return std::nullopt;
  return 180 - kapr_deg - insert.included_angle_deg;
}

ToolOutline outline(const Tool& tool) {
  const auto insert = decode_iso1832(tool.insert);
  const double re = tool.re_mm, kappa = units::rad_from_deg(tool.kapr_deg);
  ToolOutline all{re, insert_polygon(insert, tool.kapr_deg, re), {}};
  Edge major{{re, 0}, kappa}, minor{{0, re}, 0};
  if (const auto angle = minor_angle_deg(tool.kapr_deg, insert)) {
    major.on = minor.on = all.insert[0];
    minor.kappa = -units::rad_from_deg(*angle);
  }
  if (tool.holder) all.holder = external(*tool.holder, major, minor);
  if (tool.bar) all.holder = bar_outlines(*tool.bar, major);
  return all;
}

ConvexOutline rounded_insert(const ToolOutline& outline, double chord_mm) {
  const double r = outline.re_mm;
  // A chord over an angle 2 a lies within r (1 - cos a) of its arc.
  const double step =
      r > chord_mm ? 2 * std::acos(1 - chord_mm / r) : std::numbers::pi / 2;
  ConvexOutline all;
  const auto arc = [&](const OutlinePoint& centre, double kappa, double turn) {
    const int n = std::max(1, static_cast<int>(std::ceil(turn / step)));
    for (int i = 0; i <= n; ++i) all.push_back(centre - r * inward(kappa + turn * i / n));
  };
  const auto& p = outline.insert;
  if (p.empty()) {
    arc({r, r}, 0, 2 * std::numbers::pi);
    all.pop_back();  // the first again
    return all;
  }
  const auto kappa = [](const OutlinePoint& from, const OutlinePoint& to) {
    return std::atan2(to.h_mm - from.h_mm, from.z_mm - to.z_mm);
  };
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double in = kappa(p[(i + p.size() - 1) % p.size()], p[i]);
    const double turn =
        std::remainder(kappa(p[i], p[(i + 1) % p.size()]) - in, 2 * std::numbers::pi);
    arc(p[i] + to_centre(r, in, in + turn), in, turn);
  }
  return all;
}

}  // namespace turnwright::catalogue
