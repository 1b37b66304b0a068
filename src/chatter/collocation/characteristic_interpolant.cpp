#include "characteristic_interpolant.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace turnwright::chatter {
namespace {

constexpr std::size_t kPowers = 120;  // of z at most
constexpr double kRounding = 1e-13;   // of f, relative to sum |d_l|
constexpr double kBeyond = 1.1;       // largest |t| needed, because boxes overlap
constexpr double kLebesgue = 4;  // growth of errors from 17 samples to the interpolant

/// d_l of (1); the multipliers come in conjugate pairs.
std::vector<double> coefficients(const std::vector<Complex>& multipliers) {
  std::vector<Complex> c{1.0};
  for (const Complex& mu : multipliers) {
    c.push_back(0);
    for (std::size_t l = c.size(); --l > 0;) c[l] -= mu * c[l - 1];
    if (c.size() > kPowers) c.pop_back();
  }
  std::vector<double> out;
  for (const Complex& x : c) out.push_back(x.real());
  return out;
}

double size_of(const std::vector<double>& d) {
  return std::accumulate(d.begin(), d.end(), 0.0,
                         [](double sum, double x) { return sum + std::abs(x); });
}

int outside(const std::vector<Complex>& multipliers) {
  return static_cast<int>(
      std::ranges::count_if(multipliers, [](Complex mu) { return std::norm(mu) > 1; }));
}

constexpr std::size_t kMostTerms = 17;

/// T_k and its first three derivatives by t at one t.
struct Chebyshev {
  std::array<double, kMostTerms> T{1}, T1{}, T2{}, T3{};
};

Chebyshev chebyshev(std::size_t terms, double t) {
  Chebyshev c;
  c.T[1] = t;
  c.T1[1] = 1;
  for (std::size_t k = 1; k + 1 < terms; ++k) {
    c.T[k + 1] = 2 * t * c.T[k] - c.T[k - 1];
    c.T1[k + 1] = 2 * c.T[k] + 2 * t * c.T1[k] - c.T1[k - 1];
    c.T2[k + 1] = 4 * c.T1[k] + 2 * t * c.T2[k] - c.T2[k - 1];
    c.T3[k + 1] = 6 * c.T2[k] + 2 * t * c.T3[k] - c.T3[k - 1];
  }
  return c;
}

/// The samples of one interpolant at the extrema of T_n, from its upper end down.
using Samples = std::vector<std::vector<double>>;

double extremum(std::size_t i, std::size_t n) {
  return std::cos(units::kPi * static_cast<double>(i) / static_cast<double>(n));
}

// d_k = 2/n sum'' f(t_i) T_k(t_i), the first and the last halved; Clenshaw and Curtis.
std::vector<double> series_of(const Samples& samples, std::size_t l) {
  const std::size_t n = samples.size() - 1;
  std::array<double, 2 * kMostTerms> extrema;
  for (std::size_t i = 0; i < 2 * n; ++i) extrema[i] = extremum(i, n);
  std::vector<double> out(n + 1);
  for (std::size_t k = 0; k <= n; ++k) {
    double sum = 0;
    for (std::size_t i = 0; i <= n; ++i) {
      const double f = l < samples[i].size() ? samples[i][l] : 0;
      sum += (i == 0 || i == n ? 0.5 : 1) * f * extrema[i * k % (2 * n)];
    }
    out[k] = (k == 0 || k == n ? 1 : 2) * sum / static_cast<double>(n);
  }
  return out;
}

}  // namespace

DepthSample depth_sample(const std::vector<Complex>& multipliers) {
  return {.d = coefficients(multipliers), .noise = 0, .outside = outside(multipliers)};
}

std::optional<CharacteristicInterpolant> CharacteristicInterpolant::sampled(
    const SampleAt& sample, double from_mm, double to_mm, double tail) {
  CharacteristicInterpolant out;
  out.middle_ = (from_mm + to_mm) / 2;
  out.half_ = (to_mm - from_mm) / 2;
  Samples samples;
  double noise = 0;
  for (const std::size_t n : {8u, 16u}) {
    Samples finer;
    for (std::size_t i = 0; i <= n; ++i) {
      if (!samples.empty() && i % 2 == 0) {
        finer.push_back(std::move(samples[i / 2]));
        continue;
      }
      const double w = i == 0   ? to_mm
                       : i == n ? from_mm
                                : out.middle_ + out.half_ * extremum(i, n);
      DepthSample found = sample(w, i == 0 || i == n);
      if (i == 0) out.above_ = found.outside.value();
      if (i == n) out.below_ = found.outside.value();
      noise = std::max(noise, found.noise);
      finer.push_back(std::move(found.d));
    }
    samples = std::move(finer);

    double scale = 0;
    std::size_t powers = 0;
    for (const auto& d : samples) {
      scale = std::max(scale, size_of(d));
      powers = std::max(powers, d.size());
    }
    std::vector<std::vector<double>> series;
    double left = 0;
    for (std::size_t l = 0; l < powers; ++l) {
      series.push_back(series_of(samples, l));
      const auto& d = series.back();
      left += std::abs(d[n]) + std::abs(d[n - 1]) + std::abs(d[n - 2]);
    }
    if (left > tail * scale) continue;

    // Drops powers of z that are below rounding.
    double dropped = 0;
    while (series.size() > 2 && dropped + size_of(series.back()) < kRounding * scale) {
      dropped += size_of(series.back());
      series.pop_back();
    }
    if (series.size() > kPowers) return std::nullopt;
    out.powers_ = series.size();
    out.terms_ = n + 1;
    for (std::size_t k = 0; k <= n; ++k)
      for (const auto& d : series) out.d_.push_back(d[k]);
    out.noise_ = left + dropped + kRounding * scale + kLebesgue * noise;
    double weighted = 0, all = 0;
    for (std::size_t l = 0; l < series.size(); ++l) {
      weighted += static_cast<double>(l) * size_of(series[l]);
      all += size_of(series[l]);
    }
    out.shift_ = std::round(weighted / all);
    const Chebyshev edge = chebyshev(out.terms_, kBeyond);  // T^(j) is largest at the end
    for (std::size_t l = 0; l < series.size(); ++l) {
      const double e = std::abs(static_cast<double>(l) - out.shift_);
      for (std::size_t k = 0; k <= n; ++k) {
        const double c = std::abs(series[l][k]);
        out.most_.TTT += c * edge.T3[k];
        out.most_.TTU += c * edge.T2[k] * e;
        out.most_.TUU += c * edge.T1[k] * e * e;
        out.most_.UUU += c * edge.T[k] * e * e * e;
      }
    }
    return out;
  }
  return std::nullopt;
}

Local CharacteristicInterpolant::at(const Box& box, Complex u) const {
  const double t = (box.w - middle_) / half_;
  const Chebyshev c = chebyshev(terms_, t);
  std::array<double, kPowers> value{}, slope{}, curve{};  // d_l and its derivatives
  for (std::size_t k = 0; k < terms_; ++k)
    for (std::size_t l = 0; l < powers_; ++l) {
      const double d = d_[k * powers_ + l];
      value[l] += d * c.T[k];
      slope[l] += d * c.T1[k];
      curve[l] += d * c.T2[k];
    }
  Complex power = phase(box.theta);
  Complex g, g_t, g_tt, g_e, g_te, g_ee;  // e: weighted by l - s
  for (std::size_t l = 0; l < powers_; ++l, power *= u) {
    const double e = static_cast<double>(l) - shift_;
    g += value[l] * power;
    g_t += slope[l] * power;
    g_tt += curve[l] * power;
    g_e += e * value[l] * power;
    g_te += e * slope[l] * power;
    g_ee += e * e * value[l] * power;
  }
  const double a = box.w_half / half_, b = box.theta_half;
  const double tt = modulus(g_tt) + most_.TTT * a + most_.TTU * b,
               te = modulus(g_te) + most_.TTU * a + most_.TUU * b,
               ee = modulus(g_ee) + most_.TUU * a + most_.UUU * b;
  const auto degree = static_cast<double>(powers_), terms = static_cast<double>(terms_);
  return {.g = g,
          .g_w = g_t / half_,
          .g_theta = Complex(0, -1) * g_e,
          .ww = tt / (half_ * half_),
          .wt = te / half_,
          .tt = ee,
          .unseen = noise_ * (terms * terms * a + degree * b)};
}

}  // namespace turnwright::chatter
