#include "taylor_patch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "rim_samples.hpp"

namespace turnwright::chatter {
namespace {

constexpr std::size_t kSamples = 32;
constexpr double kUnseen = 1e-2;   // of the noise: terms dropped
constexpr double kUnfelt = 1e-4;   // of the change over the disc: the same
constexpr double kPrecise = 1e-7;  // noise accepted, relative to the values

const std::vector<Complex>& roots_of_samples() {
  static const auto kAll = unit_roots(kSamples);
  return kAll;
}

std::vector<Coefficients> samples(const Characteristic& f, const Disc& disc) {
  const auto& roots = roots_of_samples();
  std::vector<Coefficients> out(kSamples);
  // Phi is real for real kappa, so that conjugate samples need not be computed.
  const bool real = disc.centre.imag() == 0;
  const double rim = (std::abs(disc.centre) + disc.radius) * (1 + 1e-9);
  for (std::size_t s = 0; s < kSamples; ++s) {
    if (real && s > kSamples / 2) {
      out[s] = out[kSamples - s];
      for (Complex& c : out[s].c) c = std::conj(c);
    } else {
      out[s] = f.at(disc.centre + disc.radius * roots[s], rim);
    }
  }
  return out;
}

/// Binomial coefficients: row k holds (j + k over k), j = 0 .. kSeriesTerms - 1 - k.
const std::vector<std::array<double, kSeriesTerms>>& pascal() {
  static const auto kAll = [] {
    std::vector<std::array<double, kSeriesTerms>> all(kSeriesTerms);
    all[0].fill(1);
    for (std::size_t k = 1; k < kSeriesTerms; ++k)
      for (std::size_t j = 0; j + k < kSeriesTerms; ++j)
        all[k][j] = (j > 0 ? all[k][j - 1] : 0) + all[k - 1][j];
    return all;
  }();
  return kAll;
}

/// The polynomial about another centre: out_j = sum_k (j + k over k) c_(j+k) at^k.
void shift(std::span<const double> c, Complex at, Complex* out) {
  std::array<double, kSeriesTerms> real, imaginary;
  const std::size_t n = c.size();
  std::copy_n(c.data(), n, real.data());
  std::fill_n(imaginary.data(), n, 0.0);
  Complex power = at;
  for (std::size_t k = 1; k < n; ++k, power *= at) {
    const double* const binomial = pascal()[k].data();
    const double x = power.real(), y = power.imag();
    for (std::size_t j = 0; j < n - k; ++j) {
      const double term = binomial[j] * c[j + k];
      real[j] += x * term;
      imaginary[j] += y * term;
    }
  }
  for (std::size_t j = 0; j < n; ++j) out[j] = {real[j], imaginary[j]};
}

}  // namespace

// kappa - kappa_c = (w - w_c)(1 - z) - w_c (z - z_c).
Disc disc(const Box& box, Complex u, double rho) {
  const Complex step = 1.0 - rho * u;
  const double far = modulus(step) + rho * box.theta_half;
  return {box.w * step, box.w_half * far + std::abs(box.w) * rho * box.theta_half};
}

std::optional<Patch> Patch::sampled(const Characteristic& f, const Disc& disc,
                                    double rho) {
  const auto values = samples(f, disc);
  const auto& roots = roots_of_samples();
  Patch out;
  out.disc_ = disc;
  out.rho_ = rho;
  out.powers_ = f.states() + 1;
  double log_scale = 0;
  for (const auto& v : values) log_scale = std::max(log_scale, v.log_scale);

  out.terms_ = kSamples;
  out.c_.resize(out.powers_ * kSamples);
  std::array<double, kSamples> size{};
  double to_i = 1;
  for (std::size_t i = 0; i < out.powers_; ++i, to_i *= rho) {
    std::array<Complex, kSamples> v;
    for (std::size_t s = 0; s < kSamples; ++s)
      v[s] = values[s].c[i] * (std::exp(values[s].log_scale - log_scale) * to_i);
    const bool constant = i == 0 || i + 1 == out.powers_;
    for (std::size_t j = 0; j < (constant ? 1 : kSamples); ++j) {
      Complex sum = 0;
      for (std::size_t s = 0; s < kSamples; ++s)
        sum += v[s] * std::conj(roots[s * j % kSamples]);
      out.c_[i * kSamples + j] = sum / double{kSamples};
      size[j] += modulus(out.c_[i * kSamples + j]);
    }
  }
  const auto kept = resolved(size);
  if (!kept) return std::nullopt;
  out.keep(kept->terms);
  out.noise_ = kept->noise;
  out.bound();
  if (!(out.noise_ < kPrecise * out.scale())) return std::nullopt;
  return out;
}

Patch Patch::of(const Series& series, const Disc& disc, double rho) {
  const Complex at = disc.centre / series.radius_mm;
  const double ratio = disc.radius / series.radius_mm, rim = modulus(at) + ratio;
  Patch out;
  out.disc_ = disc;
  out.rho_ = rho;
  out.powers_ = series.c.size();
  out.noise_ = series.noise(modulus(disc.centre) + disc.radius);
  std::size_t most = 0;
  for (const auto& c : series.c) most = std::max(most, c.size());
  const double negligible = kUnseen * out.noise_;
  double tail = 0;
  for (double power = std::pow(rim, most - 1); most > 4; power /= rim) {
    double size = 0;
    for (const auto& c : series.c)
      if (c.size() >= most) size += std::abs(c[most - 1]);
    if (tail + size * power > negligible) break;
    tail += size * power;
    --most;
  }
  out.terms_ = most;
  out.c_.resize(out.powers_ * most);
  std::array<double, kSeriesTerms> size{};
  double to_i = 1;
  for (std::size_t i = 0; i < out.powers_; ++i, to_i *= rho) {
    const std::vector<double>& c = series.c[i];
    const std::size_t terms = std::min(most, c.size());
    shift({c.data(), terms}, at, &out.c_[i * most]);
    double to_j = to_i;
    for (std::size_t j = 0; j < terms; ++j, to_j *= ratio) {
      out.c_[i * most + j] *= to_j;
      size[j] += modulus(out.c_[i * most + j]);
    }
  }
  out.noise_ += tail;
  // Where many multipliers lie together f is far below the sum of its coefficients, and
  // every term is felt.
  out.drop(size,
           series.states() > 4 ? negligible : std::max(negligible, kUnfelt * size[1]));
  out.bound();
  return out;
}

void Patch::drop(std::span<const double> size, double most) {
  std::size_t terms = terms_;
  double tail = 0;
  while (terms > 4 && tail + size[terms - 1] < most) {
    tail += size[--terms];
    slope_noise_ += static_cast<double>(terms) * size[terms];
  }
  noise_ += tail;
  keep(terms);
}

void Patch::keep(std::size_t terms) {
  for (std::size_t i = 1; i < powers_; ++i)
    std::copy_n(&c_[i * terms_], terms, &c_[i * terms]);
  c_.resize(powers_ * terms);
  terms_ = terms;
}

double Patch::change() const {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < powers_; ++i) sum += modulus(c_[i * terms_ + 1]);
  return sum;
}

double Patch::scale() const {
  double largest = 0;
  for (std::size_t i = 0; i < powers_; ++i)
    largest = std::max(largest, modulus(c_[i * terms_]));
  return largest;
}

Patch Patch::shifted(const Disc& disc) const {
  const Complex s = (disc.centre - disc_.centre) / disc_.radius;
  const double ratio = disc.radius / disc_.radius;
  Patch out = *this;
  out.disc_ = disc;
  out.slope_noise_ *= ratio;
  std::array<double, kSeriesTerms> size{};
  for (std::size_t i = 0; i < powers_; ++i) {
    Complex* p = &out.c_[i * terms_];
    if (i > 0 && i + 1 < powers_)
      for (std::size_t k = 0; k + 1 < terms_; ++k)  // repeated synthetic division
        for (std::size_t j = terms_ - 1; j-- > k;) p[j] += s * p[j + 1];
    double to_j = 1;
    for (std::size_t j = 0; j < terms_of(i); ++j, to_j *= ratio) {
      p[j] *= to_j;
      size[j] += modulus(p[j]);
    }
  }
  out.drop(size, kUnseen * noise_);
  out.inside_ = out.on_rim_ = {};
  out.bound();
  return out;
}

void Patch::bound() {
  const double middle = static_cast<double>(powers_ / 2);
  for (std::size_t i = 0; i < powers_; ++i) {
    double size = 0, T = 0, TT = 0, TTT = 0;
    for (std::size_t j = 0; j < terms_of(i); ++j) {
      const auto b = static_cast<double>(j);
      const double c = modulus(c_[i * terms_ + j]);
      size += c;
      T += b * c;
      TT += b * (b - 1) * c;
      TTT += b * (b - 1) * (b - 2) * c;
    }
    const auto a = static_cast<double>(i), e = std::abs(a - middle);
    const auto add = [&](Bounds& to, double U, double UU, double UUU) {
      to.TT += TT;
      to.TU += U * T;
      to.UU += UU * size;
      to.TTT += TTT;
      to.TTU += U * TT;
      to.TUU += UU * T;
      to.UUU += UUU * size;
    };
    add(inside_, a, a * (a - 1), a * (a - 1) * (a - 2));
    add(on_rim_, e, e * e, e * e * e);
  }
}

inline Patch::Coefficient Patch::coefficient(std::size_t i, Complex t) const {
  const Complex* p = &c_[i * terms_];
  const std::size_t terms = terms_of(i);
  Coefficient c{p[terms - 1], 0, 0};
  for (std::size_t j = terms - 1; j-- > 0;) {
    c.curve = c.curve * t + c.slope;
    c.slope = c.slope * t + c.value;
    c.value = c.value * t + p[j];
  }
  return c;
}

Patch::Point Patch::point(Complex z, Complex kappa, double reach, double dz) const {
  const Complex u = z / rho_, t = (kappa - disc_.centre) / disc_.radius;
  Complex f, f_u, f_t, tt, tu, uu;  // tt and uu: half of the derivative
  for (std::size_t i = powers_; i-- > 0;) {
    const auto [value, slope, curve] = coefficient(i, t);
    uu = uu * u + f_u;
    tu = tu * u + f_t;
    tt = tt * u + curve;
    f_u = f_u * u + f;
    f_t = f_t * u + slope;
    f = f * u + value;
  }
  const double a = reach / disc_.radius, b = dz / rho_;
  const double by_t = 1 / disc_.radius, by_u = 1 / rho_;
  return {
      .f = f,
      .f_z = f_u * by_u,
      .f_kappa = f_t * by_t,
      .kk = std::min(inside_.TT, 2 * modulus(tt) + inside_.TTT * a + inside_.TTU * b) *
            by_t * by_t,
      .kz = std::min(inside_.TU, modulus(tu) + inside_.TTU * a + inside_.TUU * b) * by_t *
            by_u,
      .zz = std::min(inside_.UU, 2 * modulus(uu) + inside_.TUU * a + inside_.UUU * b) *
            by_u * by_u};
}

// F = u^(-m/2) f; E and E2 are the results of applying u d/du once and twice at constant
// kappa; _k is the derivative by kappa.  With u_theta = -i u, kappa_theta = i w rho u:
//   g_w = F_k (1 - rho u),  g_theta = i (w rho u F_k - E),
//   g_ww = F_kk (1 - rho u)^2,
//   g_wt = i (rho u F_k + (1 - rho u)(w rho u F_kk - E_k)),
//   g_tt = -E2 + 2 w rho u E_k + w rho u F_k - (w rho u)^2 F_kk.
Local Patch::at(const Box& box, Complex u) const {
  const Complex step = 1.0 - rho_ * u, kappa = box.w * step;
  const Complex t = (kappa - disc_.centre) / disc_.radius;
  const double middle = static_cast<double>(powers_ / 2);
  Complex F, F_t, F_tt, E, E_t, E2;
  for (std::size_t i = powers_; i-- > 0;) {
    const auto [value, slope, curve] = coefficient(i, t);
    const double e = static_cast<double>(i) - middle;
    F = F * u + value;
    F_t = F_t * u + slope;
    F_tt = F_tt * u + 2.0 * curve;
    E = E * u + e * value;
    E_t = E_t * u + e * slope;
    E2 = E2 * u + e * e * value;
  }
  Complex back = 1;
  for (std::size_t i = 0; i < powers_ / 2; ++i) back *= std::conj(u);

  const double wr = box.w * rho_, b = box.theta_half, by_t = 1 / disc_.radius;
  const Complex F_k = F_t * by_t;
  Local out{.g = back * F,
            .g_w = back * F_k * step,
            .g_theta = Complex(0, 1) * back * (wr * u * F_k - E)};

  const Bounds& most = on_rim_;
  const double q = modulus(step) + rho_ * b;
  const double reach = box.w_half * q + wr * b, a = reach * by_t;
  const double TT = std::min(most.TT, modulus(F_tt) + most.TTT * a + most.TTU * b);
  const double TU = std::min(most.TU, modulus(E_t) + most.TTU * a + most.TUU * b);
  const double UU = std::min(most.UU, modulus(E2) + most.TUU * a + most.UUU * b);
  const double w = (box.w + box.w_half) * rho_;
  const double kk = TT * by_t * by_t, k = modulus(F_k) + (TT * a + TU * b) * by_t;
  out.ww = kk * q * q;
  out.wt = rho_ * k + q * (w * kk + TU * by_t);
  out.tt = UU + 2 * w * TU * by_t + w * k + w * w * kk;
  out.unseen = slope_noise_ * by_t * (q * box.w_half + w * b) + middle * noise_ * b;
  return out;
}

}  // namespace turnwright::chatter
