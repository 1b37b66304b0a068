#include "turnwright/cutting/roughness_fit.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "regression.hpp"
#include "turnwright/base/dual.hpp"

namespace turnwright::cutting {
namespace {

void require_positive(double x) {
  if (!(x > 0 && std::isfinite(x)))
    throw std::domain_error("roughness_fit: a measurement is not positive");
}

struct Squares {
  std::span<const RoughnessPoint> cuts;
  Cut edge;

  static double measured(const RoughnessPoint& p) {
    return p.Ra_um ? *p.Ra_um : p.Rz_um.value_or(0);
  }
  double predicted(const RoughnessPoint& p, double hmin_mm) const {
    Cut c = edge;
    c.hmin_mm = hmin_mm;
    return p.Ra_um ? Ra_um(c, p.f_mm_rev) : Rz_um(c, p.f_mm_rev);
  }
  double operator()(double hmin_mm) const {  // Eq. (1)
    double sum = 0;
    for (const auto& p : cuts) sum += sqr(std::log(measured(p) / predicted(p, hmin_mm)));
    return sum;
  }
  // hmin of one cut alone: the positive root of R/R(0) - 1 = 4 r h/f^2 + (2 r h/f^2)^2.
  double of_one(const RoughnessPoint& p) const {
    const double more = measured(p) / predicted(p, 0) - 1;
    if (!(more > 0)) return 0;
    const double x = more / (1 + std::sqrt(1 + more));
    return x * sqr(p.f_mm_rev) / (2 * edge.corner.re_mm);
  }
};

double least_point(const Squares& S, double low, double high) {
  constexpr int kGrid = 200;
  const double step = (high - low) / kGrid;
  double best = low;
  for (int i = 1; i <= kGrid; ++i)
    if (const double h = low + i * step; S(h) < S(best)) best = h;
  const double from = std::max(low, best - step), to = std::min(high, best + step);
  const auto found = boost::math::tools::brent_find_minima(S, from, to, 40);
  for (const double end : {from, to})
    if (!(S(end) > found.second)) return end;
  return found.first;
}

// Where S reaches `most` between `in`, where it is less, and `out`.
double crossing(const Squares& S, double most, double in, double out) {
  constexpr int kHalvings = 60;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (in + out) / 2;
    (S(middle) <= most ? in : out) = middle;
  }
  return in;
}

}  // namespace

RoughnessFit fit_roughness(std::span<const RoughnessPoint> cuts, const Cut& edge,
                           const FitOptions& options) {
  require_positive(edge.corner.re_mm);
  RoughnessFit fit;
  const Squares S{cuts, edge};
  double low = HUGE_VAL, high = 0;
  for (const auto& p : cuts) {
    require_positive(p.f_mm_rev);
    require_positive(Squares::measured(p));
    low = std::min(low, S.of_one(p));
    high = std::max(high, S.of_one(p));
  }
  const std::size_t n = cuts.size();
  if (n < 2) return fit;
  const double h = high > low ? least_point(S, low, high) : low;
  const double degrees = static_cast<double>(n - 1), least = S(h);
  const double most = least * (1 + sqr(student(options.confidence, degrees)) / degrees);
  Estimate e{h, 0, h};
  if (S(0) > most) e.lower = crossing(S, most, h, 0);
  double beyond = std::max({h, high, 1e-6});
  while (S(beyond) <= most) beyond *= 2;
  e.upper = crossing(S, most, h, beyond);
  fit.hmin_mm = e;
  fit.below_corner = h == 0;
  auto& evidence = fit.evidence;
  evidence.used.resize(n);
  std::iota(evidence.used.begin(), evidence.used.end(), std::size_t{0});
  evidence.degrees_of_freedom = static_cast<int>(n - 1);
  evidence.s = std::sqrt(least / degrees);
  evidence.s_prediction = prediction_s(evidence.s, n);
  return fit;
}

}  // namespace turnwright::cutting
