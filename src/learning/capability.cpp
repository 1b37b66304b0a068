#include "turnwright/learning/capability.hpp"

#include <algorithm>
#include <cmath>

#include "turnwright/base/distributions.hpp"
#include "turnwright/base/dual.hpp"

namespace turnwright::learning {
namespace {

struct Scatter {
  double s_mm = 0, degrees = 0;
};

Indices indices(const Scatter& of, const Trend& trend, const Limits& limits,
                double confidence) {
  const double nu = std::min(of.degrees, 1e9), tail = (1 - confidence) / 2;
  const double low = std::sqrt(chi_squared_quantile(tail, nu) / nu),
               high = std::sqrt(chi_squared_upper_quantile(tail, nu) / nu);
  const double relative = 1 / std::sqrt(2 * nu), s = of.s_mm;
  Indices out;
  out.s_mm = {s, s * relative, s / high, s / low};  // (3)
  const double m = trend.mean_mm.value, up = limits.upper_mm - m;
  if (limits.lower_mm) {
    const double p = (limits.upper_mm - *limits.lower_mm) / (6 * s);  // (1)
    out.p = Estimate{p, p * relative, p * low, p * high};             // (4)
  }
  const double room = limits.lower_mm ? std::min(up, m - *limits.lower_mm) : up;
  const double pk = room / (3 * s);  // (2)
  const double u = std::hypot(trend.mean_mm.u / (3 * s), pk / std::sqrt(2 * nu));
  const double z = -normal_quantile(tail);
  out.pk = {pk, u, pk - z * u, pk + z * u};  // (5)
  return out;
}

// (6).
Scatter overall(const Series& series, const Trend& t) {
  const auto n = static_cast<double>(series.size());
  double all = 0, steady = 0;
  for (std::size_t i = 0; i < series.size(); ++i) {
    all += sqr(series[i].y_mm - t.mean_mm.value);
    steady += sqr(t.fitted_mm[i] - t.mean_mm.value);
  }
  const double s2 = sqr(t.s_mm);
  steady = std::max(0.0, steady - s2 * (n - 1 - t.degrees));
  return {std::sqrt(all / (n - 1)),
          std::max(1.0, sqr(all) / (sqr(s2) * (n - 1) + 2 * s2 * steady))};
}

}  // namespace

std::optional<Capability> capability(const Series& series, const Trend& trend,
                                     const Limits& limits, double confidence) {
  if (!(trend.s_mm > 0)) return std::nullopt;
  const Scatter all = overall(series, trend);
  return Capability{all.degrees,
                    indices({trend.s_mm, trend.degrees}, trend, limits, confidence),
                    indices(all, trend, limits, confidence)};
}

}  // namespace turnwright::learning
