#include "turnwright/tolerance/piecewise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>

#include "turnwright/base/cancelled.hpp"

namespace turnwright::tolerance {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();

/// Ascending powers of t in [0, 1].
using Polynomial = std::vector<double>;

double value(const Polynomial& p, double t) {
  double sum = 0;
  for (std::size_t j = p.size(); j-- > 0;) sum = sum * t + p[j];
  return sum;
}

Polynomial derivative(const Polynomial& p) {
  Polynomial d;
  for (std::size_t j = 1; j < p.size(); ++j) d.push_back(static_cast<double>(j) * p[j]);
  return d;
}

/// The root of p in [a, b], one end of which is below zero and the other not.
double bisect(const Polynomial& p, double a, double b) {
  const bool rises = value(p, a) < 0;
  for (;;) {
    const double m = 0.5 * (a + b);
    if (m <= a || m >= b) return m;
    const double v = value(p, m);
    if (v == 0) return m;
    ((v < 0) == rises ? a : b) = m;
  }
}

/// The sign changes of p in [0, 1], in rising order.  A root at which p only touches zero
/// is no turning point.
std::vector<double> roots(Polynomial p) {
  while (!p.empty() && p.back() == 0) p.pop_back();
  if (p.size() < 2) return {};
  std::vector<double> stops{0};
  for (const double t : roots(derivative(p))) stops.push_back(t);
  stops.push_back(1);
  std::vector<double> out;
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
    const double va = value(p, stops[i]), vb = value(p, stops[i + 1]);
    if ((va < 0) != (vb < 0)) out.push_back(bisect(p, stops[i], stops[i + 1]));
  }
  return out;
}

struct Point {
  double x, y;
};

/// Piece k in t = s/h; x = x0 + dx t is the position on the whole profile.
struct Piece {
  Polynomial p;
  double x0, dx;
};

/// Pieces of the profile with its length scaled to 1, so that slopes and e have the same
/// order of magnitude.
std::vector<Piece> pieces(const PiecewisePolynomial& f) {
  const double first = f.breaks_mm.front();
  const double length = f.breaks_mm.back() - first;
  std::vector<Piece> out;
  for (std::size_t k = 0; k < f.coefficients.size(); ++k) {
    const double h = f.breaks_mm[k + 1] - f.breaks_mm[k];
    Piece piece{.p = f.coefficients[k],
                .x0 = (f.breaks_mm[k] - first) / length,
                .dx = h / length};
    double power = 1;
    for (double& c : piece.p) {
      c *= power;
      power *= h;
    }
    out.push_back(std::move(piece));
  }
  return out;
}

/// Ends and turning points of e - a x on every piece, y = e there.
std::vector<Point> turning_points(std::span<const Piece> all, double a) {
  std::vector<Point> out;
  for (const Piece& piece : all) {
    Polynomial tilted = derivative(piece.p);
    if (tilted.empty()) tilted.push_back(0);
    tilted[0] -= a * piece.dx;
    std::vector<double> ts = roots(tilted);
    ts.push_back(0);
    ts.push_back(1);
    for (const double t : ts) out.push_back({piece.x0 + piece.dx * t, value(piece.p, t)});
  }
  return out;
}

Extremes about_line(std::span<const Point> points, double a) {
  Extremes e{std::numeric_limits<double>::infinity(),
             -std::numeric_limits<double>::infinity()};
  for (const Point& p : points) {
    e.min_mm = std::min(e.min_mm, p.y - a * p.x);
    e.max_mm = std::max(e.max_mm, p.y - a * p.x);
  }
  return e;
}

double width(const Extremes& e) { return e.max_mm - e.min_mm; }

/// Upper hull (sign +1) or lower hull (-1) of points sorted by x.
std::vector<Point> hull(std::span<const Point> points, double sign) {
  std::vector<Point> h;
  for (const Point& p : points) {
    while (h.size() >= 2) {
      const Point &a = h[h.size() - 2], &b = h.back();
      const double turn = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
      if (sign * turn < 0) break;
      h.pop_back();
    }
    h.push_back(p);
  }
  return h;
}

/// Eq. (2) for finitely many points.  The width is convex in the slope and bends only at
/// the slopes of the hull's edges: the least of these is found by halving.
Zone zone_of(std::vector<Point> points) {
  std::ranges::sort(points, [](const Point& a, const Point& b) {
    return a.x != b.x ? a.x < b.x : a.y < b.y;
  });
  std::vector<Point> corners;
  std::vector<double> slopes;
  for (const double sign : {1.0, -1.0}) {
    const std::vector<Point> h = hull(points, sign);
    corners.insert(corners.end(), h.begin(), h.end());
    for (std::size_t i = 0; i + 1 < h.size(); ++i)
      if (h[i + 1].x > h[i].x)
        slopes.push_back((h[i + 1].y - h[i].y) / (h[i + 1].x - h[i].x));
  }
  if (slopes.empty()) slopes.push_back(0);
  std::ranges::sort(slopes);
  const auto width_at = [&](std::size_t i) {
    return width(about_line(corners, slopes[i]));
  };
  std::size_t low = 0, high = slopes.size() - 1;
  while (low < high) {
    const std::size_t mid = (low + high) / 2;
    if (width_at(mid) <= width_at(mid + 1))
      high = mid;
    else
      low = mid + 1;
  }
  return {.width_mm = width_at(low), .slope = slopes[low]};
}

Zone minimum_zone_of(const PiecewisePolynomial& f, double magnitude) {
  const std::vector<Piece> all = pieces(f);
  const double length = f.breaks_mm.back() - f.breaks_mm.front();
  std::vector<Point> points = turning_points(all, 0);
  Zone best{.width_mm = std::numeric_limits<double>::infinity(), .slope = 0};
  // Each round at least halves the interval of possible slopes.  Where the width is
  // smooth in the slope its error falls by a factor of four: 50 rounds reach 2^-100.
  for (int round = 0; round < 50; ++round) {
    leave_if_asked();
    const Zone lower = zone_of(points);
    const std::vector<Point> next = turning_points(all, lower.slope);
    const double upper = width(about_line(next, lower.slope));
    if (upper < best.width_mm) best = {upper, lower.slope / length};
    if (best.width_mm - lower.width_mm <= 1e-12 * best.width_mm + 8 * kEps * magnitude)
      break;
    points.insert(points.end(), next.begin(), next.end());
  }
  return best;
}

void fail(const std::string& what) { throw std::domain_error("profile: " + what); }

void check_finite(std::span<const double> numbers, const char* name) {
  for (const double x : numbers)
    if (!std::isfinite(x)) fail(fmt::format("{} must be finite", name));
}

}  // namespace

bool empty(const Profile& profile) {
  if (const auto* s = std::get_if<Samples>(&profile)) return s->e_mm.empty();
  return std::get<PiecewisePolynomial>(profile).coefficients.empty();
}

void check(const Profile& profile) {
  if (empty(profile)) fail("no error is given");
  if (const auto* s = std::get_if<Samples>(&profile)) {
    check_finite(s->e_mm, "e_mm");
    check_finite(s->z_mm, "z_mm");
    if (!s->z_mm.empty() && s->z_mm.size() != s->e_mm.size())
      fail("z_mm and e_mm must be equally many");
    if (!std::ranges::is_sorted(s->z_mm)) fail("z_mm must not fall");
    return;
  }
  const auto& f = std::get<PiecewisePolynomial>(profile);
  check_finite(f.breaks_mm, "breaks_mm");
  if (f.breaks_mm.size() != f.coefficients.size() + 1)
    fail("there must be one break more than pieces");
  for (std::size_t k = 0; k < f.coefficients.size(); ++k) {
    if (!(f.breaks_mm[k + 1] > f.breaks_mm[k])) fail("breaks_mm must rise");
    if (f.coefficients[k].empty()) fail("a piece has no coefficient");
    check_finite(f.coefficients[k], "coefficients");
  }
  if (!std::isfinite(magnitude_mm(profile))) fail("e is not finite");
}

double magnitude_mm(const Profile& profile) {
  double most = 0;
  if (const auto* s = std::get_if<Samples>(&profile)) {
    for (const double e : s->e_mm) most = std::max(most, std::abs(e));
    return most;
  }
  for (const Piece& piece : pieces(std::get<PiecewisePolynomial>(profile))) {
    double sum = 0;
    for (const double c : piece.p) sum += std::abs(c);
    if (!(sum <= most)) most = sum;  // NaN is kept
  }
  return most;
}

Extremes extremes(const Profile& profile) {
  check(profile);
  if (const auto* s = std::get_if<Samples>(&profile)) {
    const auto [low, high] = std::ranges::minmax(s->e_mm);
    return {low, high};
  }
  return about_line(turning_points(pieces(std::get<PiecewisePolynomial>(profile)), 0), 0);
}

Zone minimum_zone(const Profile& profile) {
  check(profile);
  if (const auto* f = std::get_if<PiecewisePolynomial>(&profile))
    return minimum_zone_of(*f, magnitude_mm(profile));
  const auto& s = std::get<Samples>(profile);
  std::vector<Point> points;
  for (std::size_t i = 0; i < s.e_mm.size(); ++i)
    points.push_back({s.z_mm.empty() ? static_cast<double>(i) : s.z_mm[i], s.e_mm[i]});
  return zone_of(std::move(points));
}

}  // namespace turnwright::tolerance
