#include "series.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "rim_samples.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::chatter {
namespace {

constexpr double kDropped = 1e-18;  // of a polynomial relative to its largest term

using Poly = std::vector<double>;

/// sum += sign a b, up to kSeriesTerms terms.
void add_product(Poly& sum, double sign, const Poly& a, const Poly& b) {
  const std::size_t terms = std::min(a.size() + b.size() - 1, kSeriesTerms);
  if (sum.size() < terms) sum.resize(terms, 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double factor = sign * a[i];
    const std::size_t end = std::min(b.size(), terms - std::min(i, terms));
    for (std::size_t j = 0; j < end; ++j) sum[i + j] += factor * b[j];
  }
}

/// Square matrix of polynomials in kappa/kappa_max, one matrix per power as in SubArc.
struct PolyMatrix {
  std::size_t rows = 0;
  Poly coefficients;
  std::size_t entries() const { return rows * rows; }
  std::size_t terms() const { return coefficients.size() / entries(); }
  Poly operator()(std::size_t r, std::size_t c) const {
    Poly entry(terms());
    for (std::size_t j = 0; j < entry.size(); ++j)
      entry[j] = coefficients[j * entries() + r * rows + c];
    return entry;
  }
};

PolyMatrix scaled(const SubArc& stretch, std::size_t m, double kappa_max) {
  PolyMatrix out{m, stretch.coefficients};
  double power = 1;
  for (std::size_t j = 0; j <= stretch.degree; ++j, power *= kappa_max)
    for (std::size_t e = 0; e < m * m; ++e) out.coefficients[j * m * m + e] *= power;
  return out;
}

/// Drops terms that are lost in the rounding of the largest one; false if there are none.
bool trim(PolyMatrix& a) {
  const auto largest = [&](std::size_t j) {
    double most = 0;
    for (std::size_t e = 0; e < a.entries(); ++e)
      most = std::max(most, std::abs(a.coefficients[j * a.entries() + e]));
    return most;
  };
  std::size_t kept = a.terms();
  double most = 0;
  for (std::size_t j = 0; j < kept; ++j) most = std::max(most, largest(j));
  while (kept > 1 && largest(kept - 1) < kDropped * most) --kept;
  a.coefficients.resize(kept * a.entries());
  return kept < kSeriesTerms;
}

/// sum += a b, matrices of order m row by row.
template <std::size_t m>
void add_product(double* sum, const double* a, const double* b) {
  for (std::size_t r = 0; r < m; ++r) {
    double row[m];
    std::copy_n(sum + r * m, m, row);
    for (std::size_t i = 0; i < m; ++i)
      for (std::size_t c = 0; c < m; ++c) row[c] += a[r * m + i] * b[i * m + c];
    std::copy_n(row, m, sum + r * m);
  }
}

template <std::size_t m>
PolyMatrix product(const PolyMatrix& a, const PolyMatrix& b) {
  const std::size_t terms = std::min(a.terms() + b.terms() - 1, kSeriesTerms);
  PolyMatrix out{m, Poly(terms * m * m, 0)};
  for (std::size_t i = 0; i < a.terms(); ++i)
    for (std::size_t j = 0; j < b.terms() && i + j < terms; ++j)
      add_product<m>(&out.coefficients[(i + j) * m * m], &a.coefficients[i * m * m],
                     &b.coefficients[j * m * m]);
  return out;
}

/// The entries of a matrix one by one.
using Entries = std::array<std::array<Poly, 4>, 4>;

/// Rows r, s and columns c, d.
Poly minor(const Entries& a, std::size_t r, std::size_t s, std::size_t c, std::size_t d) {
  Poly out;
  add_product(out, 1, a[r][c], a[s][d]);
  add_product(out, -1, a[r][d], a[s][c]);
  return out;
}

void raise(Poly& bound, const Poly& by) {
  if (bound.size() < by.size()) bound.resize(by.size(), 0);
  for (std::size_t j = 0; j < by.size(); ++j)
    bound[j] = std::max(bound[j], std::abs(by[j]));
}

/// c_i = (-1)^i times the sum of the principal minors of order i; `minors` bounds those
/// of order 2.
std::vector<Poly> characteristic(const PolyMatrix& matrix, Poly& minors) {
  const std::size_t m = matrix.rows;
  Entries phi;
  for (std::size_t r = 0; r < m; ++r)
    for (std::size_t s = 0; s < m; ++s) phi[r][s] = matrix(r, s);
  std::vector<Poly> c(m + 1);
  const Poly minus{-1};
  for (std::size_t i = 0; i < m; ++i) add_product(c[1], 1, minus, phi[i][i]);
  if (m == 2) return c;
  const Poly one{1};
  std::array<std::array<Poly, 4>, 4> last;  // principal
  for (std::size_t r = 0; r < 4; ++r)
    for (std::size_t s = r + 1; s < 4; ++s) {
      last[r][s] = minor(phi, r, s, r, s);
      add_product(c[2], 1, one, last[r][s]);
      raise(minors, last[r][s]);
    }
  // The minor of rows and columns a < b < d, along its first row.
  constexpr std::array<std::array<std::size_t, 3>, 4> kTriples{
      {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}};
  for (const auto& [a, b, d] : kTriples) {
    const Poly second = minor(phi, b, d, a, d), third = minor(phi, b, d, a, b);
    add_product(c[3], -1, phi[a][a], last[b][d]);
    add_product(c[3], 1, phi[a][b], second);
    add_product(c[3], -1, phi[a][d], third);
    raise(minors, second);
    raise(minors, third);
  }
  return c;
}

}  // namespace

double Series::noise(double kappa_abs) const {
  const auto at = [t = kappa_abs / radius_mm](const std::vector<double>& p) {
    double sum = 0;
    for (std::size_t j = p.size(); j-- > 0;) sum = sum * t + p[j];
    return sum;
  };
  const double bound = at(size);
  return sampling +
         rounding * (1 + bound * (1 + (states() == 2 ? 0 : bound + at(minors))));
}

// Horner's rule in kappa/radius = s (1 - z).
std::vector<double> by_powers(const Series& series, double w_mm) {
  const double s = w_mm / series.radius_mm;
  std::vector<double> out;
  for (std::size_t i = 0; i < series.c.size(); ++i) {
    const std::vector<double>& c = series.c[i];
    std::vector<double> p(c.size(), 0);
    for (std::size_t j = c.size(); j-- > 0;) {
      for (std::size_t l = c.size() - 1; l > 0; --l) p[l] = s * (p[l] - p[l - 1]);
      p[0] = s * p[0] + c[j];
    }
    if (out.size() < i + p.size()) out.resize(i + p.size(), 0);
    for (std::size_t l = 0; l < p.size(); ++l) out[i + l] += p[l];
  }
  return out;
}

SeriesValue value(const Series& series, std::complex<double> z,
                  std::complex<double> kappa_mm) {
  const std::complex<double> t = kappa_mm / series.radius_mm;
  SeriesValue out;
  for (std::size_t i = series.c.size(); i-- > 0;) {
    const std::vector<double>& c = series.c[i];
    std::complex<double> sum = 0, slope = 0;
    for (std::size_t j = c.size(); j-- > 0;) {
      slope = slope * t + sum;
      sum = sum * t + c[j];
    }
    out.f_z = out.f_z * z + out.f;
    out.f = out.f * z + sum;
    out.f_kappa = out.f_kappa * z + slope;
  }
  out.f_kappa /= series.radius_mm;
  return out;
}

std::optional<Series> series(const Propagator& propagator, double kappa_max_mm) {
  const std::size_t m = propagator.states;
  if (m != 2 && m != 4) return std::nullopt;
  PolyMatrix phi = scaled(propagator.stretches.front(), m, kappa_max_mm);
  for (std::size_t k = 1; k < propagator.stretches.size(); ++k) {
    const PolyMatrix next = scaled(propagator.stretches[k], m, kappa_max_mm);
    phi = m == 2 ? product<2>(next, phi) : product<4>(next, phi);
    if (!trim(phi)) return std::nullopt;
  }
  Series out{.radius_mm = kappa_max_mm, .c = {}, .size = {}, .minors = {}};
  out.c = characteristic(phi, out.minors);
  out.c[0] = {1};
  out.c[m] = {std::exp(propagator.log_det)};
  out.size.assign(phi.terms(), 0);
  for (std::size_t j = 0; j < out.size.size(); ++j)
    for (std::size_t r = 0; r < m; ++r) {
      double row = 0;
      for (std::size_t c = 0; c < m; ++c)
        row += std::abs(phi.coefficients[j * m * m + r * m + c]);
      out.size[j] = std::max(out.size[j], row);
    }
  constexpr double kEach = 4;  // rounding of an interval, in units of the last place
  out.rounding = kEach * (1 + static_cast<double>(propagator.stretches.size())) *
                 std::numeric_limits<double>::epsilon();
  return out;
}

namespace {

/// Coefficients from samples at e^(i pi s/n), s = 0 .. n, of the rim; Phi is real for real
/// kappa, so that the other half mirrors them.
std::optional<Series> from_samples(const std::vector<Coefficients>& samples,
                                   double radius_mm) {
  const std::size_t n = samples.size() - 1, m = samples.front().c.size() - 1;
  const auto roots = unit_roots(2 * n);
  Series out{.radius_mm = radius_mm, .c = {}, .size = {}, .minors = {}};
  out.c.assign(m + 1, Poly(2 * n));
  out.c[0] = {1};
  out.c[m] = {samples.front().c[m].real()};
  std::vector<double> size(2 * n, 0);
  size[0] = 1 + out.c[m][0];
  for (std::size_t i = 1; i < m; ++i)
    for (std::size_t j = 0; j < 2 * n; ++j) {
      double sum = 0;
      for (std::size_t s = 0; s <= n; ++s) {
        const Complex& x = samples[s].c[i];
        const Complex& root = roots[s * j % (2 * n)];
        sum += (s == 0 || s == n ? 0.5 : 1) *
               (x.real() * root.real() + x.imag() * root.imag());
      }
      out.c[i][j] = sum / static_cast<double>(n);
      size[j] += std::abs(out.c[i][j]);
    }
  const auto kept = resolved(size);
  if (!kept) return std::nullopt;
  for (std::size_t i = 1; i < m; ++i) out.c[i].resize(kept->terms);
  out.sampling = kept->noise;
  return out;
}

}  // namespace

std::optional<Series> sampled_series(const Characteristic& f, double kappa_max_mm,
                                     double noise) {
  constexpr double kFarBelow = 1e-2;  // of the noise accepted: not worth more samples
  const double rim = kappa_max_mm * (1 + 1e-9);
  const auto sample = [&](std::size_t s, std::size_t n) {
    return f.at(kappa_max_mm * std::polar(1.0, units::kPi * static_cast<double>(s) /
                                                   static_cast<double>(n)),
                rim);
  };
  std::vector<Coefficients> samples{sample(0, 1), sample(1, 1)};
  for (const Coefficients& end : samples) {
    double size = 0;
    for (const Complex& c : end.c) size += std::abs(c);
    if (end.log_scale > 0 || !(kRounding * size < noise)) return std::nullopt;
  }
  for (std::size_t n = 2; n <= kSeriesTerms / 2; n *= 2) {
    std::vector<Coefficients> finer;
    for (std::size_t s = 0; s <= n; ++s)
      finer.push_back(s % 2 == 0 ? std::move(samples[s / 2]) : sample(s, n));
    samples = std::move(finer);
    if (n < 8) continue;
    auto series = from_samples(samples, kappa_max_mm);
    const bool last = n > kSeriesTerms / 4;
    if (series && series->sampling < (last ? 1 : kFarBelow) * noise) return series;
  }
  return std::nullopt;
}

std::optional<DeepSeries> series_up_to(const Characteristic& f, double ap_max_mm,
                                       double most_growth) {
  constexpr double kReach = 2.2;     // kappa over depth, with room for boxes at the edge
  constexpr double kPrecise = 1e-7;  // noise accepted
  const bool few = f.system().modes.size() <= 2;
  for (double w = ap_max_mm; w > 1e-6 * ap_max_mm; w /= 2) {
    const double kappa_max = kReach * w;
    if (f.growth(kappa_max) > most_growth) continue;
    auto made =
        few ? series(propagator(f.system(), f.arcs(), f.n_rpm(), kappa_max, kFine),
                     kappa_max)
            : sampled_series(f, kappa_max, kPrecise);
    while (made && w > 1e-6 * ap_max_mm) {
      if (made->noise(kReach * w) < kPrecise) return DeepSeries{std::move(*made), w};
      w /= 2;
    }
  }
  return std::nullopt;
}

}  // namespace turnwright::chatter
