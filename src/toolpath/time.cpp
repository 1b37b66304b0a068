#include <algorithm>
#include <cmath>

#include "turnwright/base/dual.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/toolpath/setup_program.hpp"

namespace turnwright::toolpath {
namespace {

// Integral of max(2 pi |x|/(1000 v), 1/n_cap) from the axis to a radius.
double minutes_per_feed(const Step& s, double x_mm) {
  const double x = std::abs(x_mm), per_mm = 2 * units::kPi / (1000 * s.S);
  const double slow = 1 / (per_mm * s.n_max_rpm);  // inside it the limit holds
  const double sum = x <= slow ? x / s.n_max_rpm
                               : slow / s.n_max_rpm + per_mm * (sqr(x) - sqr(slow)) / 2;
  return std::copysign(sum, x_mm);
}

// Eq. (1) along a straight line between two radii.
double feed_min(const Step& s, double length_mm, double x0_mm, double x1_mm) {
  constexpr double kSame_mm = 1e-9;
  if (!s.constant_surface_speed) return length_mm / (s.f_mm_rev * s.S);
  if (std::abs(x1_mm - x0_mm) < kSame_mm) {
    const double n =
        std::min(s.n_max_rpm, 1000 * s.S / (2 * units::kPi * std::abs(x0_mm)));
    return length_mm / (s.f_mm_rev * n);
  }
  return length_mm / s.f_mm_rev *
         (minutes_per_feed(s, x1_mm) - minutes_per_feed(s, x0_mm)) / (x1_mm - x0_mm);
}

double arc_mm(const Move& from, const Move& arc) {
  const auto angle = [&](const Move& m) {
    return std::atan2(m.x_mm - arc.centre.h_mm, m.z_mm - arc.centre.z_mm);
  };
  return std::hypot(from.x_mm - arc.centre.h_mm, from.z_mm - arc.centre.z_mm) *
         std::abs(std::remainder(angle(arc) - angle(from), 2 * units::kPi));
}

// The part of a straight line that is in the cut, as shares of its length.
struct Part {
  double from = 0, to = 0;
};
Part in_cut(const InCut& cut, const Move& a, const Move& b) {
  const double p = cut.across ? a.x_mm : a.z_mm, q = cut.across ? b.x_mm : b.z_mm;
  if (p == q) return cut.from_mm <= p && p <= cut.to_mm ? Part{0, 1} : Part{};
  const auto [low, high] =
      std::minmax({(cut.from_mm - p) / (q - p), (cut.to_mm - p) / (q - p)});
  return {std::clamp(low, 0.0, 1.0), std::clamp(high, 0.0, 1.0)};
}

// Between two shares of the way of a move at feed.
double feed_min(const Step& s, const Move& a, const Move& b, double u, double w) {
  const double length =
      b.kind == Move::Kind::arc
          ? arc_mm(a, b)
          : std::hypot(b.x_mm - a.x_mm, b.y_mm - a.y_mm, b.z_mm - a.z_mm);
  if (s.milling) return length * (w - u) / (b.feed_share * s.milling->f_mm_min);
  return feed_min(s, length * (w - u), std::lerp(a.x_mm, b.x_mm, u),
                  std::lerp(a.x_mm, b.x_mm, w));
}

void add_feed(const Step& s, const Move& a, const Move& b, Minutes& sum) {
  const auto between = [&](double u, double w) { return feed_min(s, a, b, u, w); };
  const auto part = in_cut(s.in_cut, a, b);
  const double cut = between(part.from, part.to);
  sum.cutting += cut;
  const double air = between(0, part.from) + between(part.to, 1);
  sum.air += air;
  if (b.entering) sum.entering += air;
}

}  // namespace

double move_min(const Step& step, const Move& from, const Move& to,
                const catalogue::Lathe& machine) {
  if (to.kind != Move::Kind::rapid) return feed_min(step, from, to, 0, 1);
  return std::max({std::abs(to.x_mm - from.x_mm), std::abs(to.y_mm - from.y_mm),
                   std::abs(to.z_mm - from.z_mm)}) /
         machine.rapid_mm_min;
}

Minutes minutes(const SetupProgram& p, const catalogue::Lathe& machine) {
  Minutes sum;
  Move at{Move::Kind::rapid, p.change_x_mm, p.change_z_mm};
  int tool = 0;
  for (const auto& s : p.steps) {
    if (s.stop) {
      sum.operator_stops += s.stop_min;
      continue;
    }
    if (s.tool != tool) sum.tool_changes += machine.index_min;
    tool = s.tool;
    for (const auto& m : s.moves) {
      if (m.kind == Move::Kind::rapid)
        sum.air += move_min(s, at, m, machine);
      else
        add_feed(s, at, m, sum);
      at = m;
    }
  }
  return sum;
}

}  // namespace turnwright::toolpath
