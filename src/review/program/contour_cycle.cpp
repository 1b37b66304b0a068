#include "contour_cycle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace turnwright::review {
namespace {

using toolpath::Move;
using toolpath::Point;
using Kind = Move::Kind;

constexpr int kMostPasses = 500;
constexpr int kChordsOfArc = 24;
constexpr double kLevel_mm = 1e-6;

void add_points(const ReadMove& m, std::vector<Point>& all) {
  const auto& c = m.to.centre;
  if (m.to.kind == Kind::arc && m.from) {
    const double R = std::hypot(m.from->h_mm - c.h_mm, m.from->z_mm - c.z_mm);
    const double a = std::atan2(m.from->h_mm - c.h_mm, m.from->z_mm - c.z_mm);
    const double b = std::atan2(m.to.x_mm - c.h_mm, m.to.z_mm - c.z_mm);
    const double turn = std::remainder(b - a, 2 * std::numbers::pi);
    for (int i = 1; i < kChordsOfArc; ++i) {
      const double t = a + turn * i / kChordsOfArc;
      all.push_back({c.h_mm + R * std::sin(t), c.z_mm + R * std::cos(t)});
    }
  }
  all.push_back({m.to.x_mm, m.to.z_mm});
}

// Its corners, from the end of its first block, with what is left on it.
std::vector<Point> points(const Contour& contour, const RoughingCycle& cycle) {
  std::vector<Point> all;
  for (const auto& run : contour.runs)
    for (const auto& m : run.moves) add_points(m, all);
  for (auto& p : all) {
    p.h_mm += cycle.left_x_mm;
    p.z_mm += cycle.left_z_mm;
  }
  return all;
}

bool steady(const std::vector<Point>& all, double outwards) {
  for (std::size_t i = 1; i < all.size(); ++i)
    if (outwards * (all[i].h_mm - all[i - 1].h_mm) < -kLevel_mm ||
        all[i].z_mm - all[i - 1].z_mm > kLevel_mm)
      return false;
  return true;
}

// Where the contour reaches a level, seen from its beginning.
double reached_z(const std::vector<Point>& all, double level_mm, double outwards) {
  for (std::size_t i = 1; i < all.size(); ++i) {
    const auto &a = all[i - 1], &b = all[i];
    if (outwards * (b.h_mm - level_mm) < 0) continue;
    const double rise = b.h_mm - a.h_mm;
    const double u = std::abs(rise) > kLevel_mm ? (level_mm - a.h_mm) / rise : 0;
    return std::lerp(a.z_mm, b.z_mm, std::clamp(u, 0.0, 1.0));
  }
  return all.back().z_mm;
}

}  // namespace

void rough(ModalState& s, const Contour& contour, const RoughingCycle& cycle) {
  const auto all = points(contour, cycle);
  if (!s.x_mm || !s.z_mm || all.size() < 2 || !(cycle.depth_mm > 0))
    return s.unknown("G71", "Its contour, its depth or the tool's place is not known.");
  const double x0 = *s.x_mm, z0 = *s.z_mm;
  const double outwards = all.front().h_mm <= x0 ? 1 : -1;
  if (!steady(all, outwards))
    return s.unknown("G71", "Only contours that go one way in X and in Z are followed.");
  int k = 1;
  for (double x = x0 - outwards * cycle.depth_mm;
       outwards * (x - all.front().h_mm) > kLevel_mm && k <= kMostPasses;
       x = x0 - outwards * cycle.depth_mm * ++k) {
    const double z = reached_z(all, x, outwards);
    s.straight(Kind::rapid, x, z0);
    s.straight(Kind::feed, x, z);
    s.straight(Kind::feed, x + outwards * cycle.retract_mm, z + cycle.retract_mm);
    s.straight(Kind::rapid, x + outwards * cycle.retract_mm, z0);
  }
  if (k > kMostPasses) s.unknown("G71", "It has more than 500 passes.");
  s.straight(Kind::rapid, all.front().h_mm, z0);
  for (const auto& p : all) s.straight(Kind::feed, p.h_mm, p.z_mm);
  s.straight(Kind::rapid, x0, *s.z_mm);
  s.straight(Kind::rapid, x0, z0);
}

void finish(ModalState& s, const Contour& contour) {
  if (!s.x_mm || !s.z_mm)
    return s.unknown("G70 from a place that is not known",
                     "X or Z was not given before it.");
  const double x0 = *s.x_mm, z0 = *s.z_mm, F = s.F;
  const auto F_line = s.F_line;
  for (const auto& run : contour.runs) {
    const bool own = run.step.f_mm_rev > 0 && s.per_revolution;
    if (own) s.F = run.step.f_mm_rev;
    for (const auto& m : run.moves) {
      if (own) s.F_line = m.words.F_line;
      s.to(m.to);
    }
  }
  s.F = F;
  s.F_line = F_line;
  s.straight(Kind::rapid, x0, *s.z_mm);
  s.straight(Kind::rapid, x0, z0);
}

}  // namespace turnwright::review
