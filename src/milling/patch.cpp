#include "patch.hpp"

#include <algorithm>
#include <cmath>

#include "turnwright/base/units.hpp"

namespace turnwright::milling {
namespace {

constexpr std::size_t kSamples = 32;
constexpr double kTail = 1e-13;      // of the series, relative to its largest term
constexpr double kFloor = 1e-10;     // the same, where rounding ends the descent
constexpr double kRounding = 1e-13;  // of a sample, relative to the largest
constexpr double kPrecise = 1e-7;    // noise accepted, relative to the values

const std::vector<Complex>& unit_roots() {
  static const auto kAll = [] {
    std::vector<Complex> all;
    for (std::size_t k = 0; k < kSamples; ++k)
      all.push_back(std::polar(1.0, 2 * units::kPi * static_cast<double>(k) / kSamples));
    return all;
  }();
  return kAll;
}

std::vector<Coefficients> samples(const Characteristic& f, const Disc& disc) {
  const auto& roots = unit_roots();
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

}  // namespace

// kappa - kappa_c = (w - w_c)(1 - z) - w_c (z - z_c).
Disc disc(const Box& box, double rho) {
  const Complex step = 1.0 - std::polar(rho, -box.theta);
  const double far = std::abs(step) + rho * box.theta_half;
  return {box.w * step, box.w_half * far + std::abs(box.w) * rho * box.theta_half};
}

std::optional<Patch> Patch::sampled(const Characteristic& f, const Disc& disc,
                                    double rho) {
  const auto values = samples(f, disc);
  const auto& roots = unit_roots();
  Patch out;
  out.disc_ = disc;
  out.rho_ = rho;
  out.powers_ = f.states() + 1;
  double log_scale = 0;
  for (const auto& v : values) log_scale = std::max(log_scale, v.log_scale);

  std::vector<Complex> all(out.powers_ * kSamples);
  std::vector<double> size(kSamples, 0);
  double to_i = 1;
  for (std::size_t i = 0; i < out.powers_; ++i, to_i *= rho) {
    std::vector<Complex> v(kSamples);
    for (std::size_t s = 0; s < kSamples; ++s)
      v[s] = values[s].c[i] * (std::exp(values[s].log_scale - log_scale) * to_i);
    const bool constant = i == 0 || i + 1 == out.powers_;
    for (std::size_t j = 0; j < (constant ? 1 : kSamples); ++j) {
      Complex sum = 0;
      for (std::size_t s = 0; s < kSamples; ++s)
        sum += v[s] * std::conj(roots[s * j % kSamples]);
      all[i * kSamples + j] = sum / double{kSamples};
      size[j] += std::abs(all[i * kSamples + j]);
    }
  }
  const double largest = *std::ranges::max_element(size);
  if (!(largest < 1e300)) return std::nullopt;
  // What the last quarter holds is rounding if the series has come down before.
  const double floor = *std::max_element(size.end() - kSamples / 4, size.end());
  if (!(floor < kFloor * largest)) return std::nullopt;
  std::size_t terms = kSamples;
  double tail = 0;
  while (terms > 3 && size[terms - 1] <= std::max(kTail * largest, 2 * floor))
    tail += size[--terms];
  out.terms_ = terms;
  for (std::size_t i = 0; i < out.powers_; ++i)
    out.c_.insert(out.c_.end(), &all[i * kSamples], &all[i * kSamples] + terms);
  out.noise_ = 2 * tail + kSamples * floor + kRounding * largest;
  out.bound();
  if (!(out.noise_ < kPrecise * out.scale())) return std::nullopt;
  return out;
}

double Patch::scale() const {
  double largest = 0;
  for (std::size_t i = 0; i < powers_; ++i)
    largest = std::max(largest, std::abs(c_[i * terms_]));
  return largest;
}

Patch Patch::shifted(const Disc& disc) const {
  const Complex s = (disc.centre - disc_.centre) / disc_.radius;
  const double ratio = disc.radius / disc_.radius;
  std::vector<Complex> c = c_;
  std::vector<double> size(terms_, 0);
  double to_j = 1;
  for (std::size_t i = 0; i < powers_; ++i) {
    Complex* p = &c[i * terms_];
    if (i > 0 && i + 1 < powers_)
      for (std::size_t k = 0; k + 1 < terms_; ++k)  // repeated synthetic division
        for (std::size_t j = terms_ - 1; j-- > k;) p[j] += s * p[j + 1];
    to_j = 1;
    for (std::size_t j = 0; j < terms_; ++j, to_j *= ratio) {
      p[j] *= to_j;
      size[j] += std::abs(p[j]);
    }
  }
  const double largest = *std::ranges::max_element(size);
  std::size_t terms = terms_;
  double tail = 0;
  while (terms > 3 && tail + size[terms - 1] < 1e-2 * kTail * largest)
    tail += size[--terms];
  Patch out;
  out.disc_ = disc;
  out.rho_ = rho_;
  out.powers_ = powers_;
  out.terms_ = terms;
  for (std::size_t i = 0; i < powers_; ++i)
    out.c_.insert(out.c_.end(), &c[i * terms_], &c[i * terms_] + terms);
  out.noise_ = noise_ + tail;
  out.bound();
  return out;
}

void Patch::bound() {
  for (std::size_t i = 0; i < powers_; ++i)
    for (std::size_t j = 0; j < terms_; ++j) {
      const double size = std::abs(c_[i * terms_ + j]);
      const auto a = static_cast<double>(i), b = static_cast<double>(j);
      kk_ += b * (b - 1) * size;
      kz_ += a * b * size;
      zz_ += a * (a - 1) * size;
    }
  kk_ /= disc_.radius * disc_.radius;
  kz_ /= disc_.radius;
}

Patch::Point Patch::point(Complex z, Complex kappa) const {
  const Complex u = z / rho_, t = (kappa - disc_.centre) / disc_.radius;
  Point out{.f = 0, .f_z = 0, .f_kappa = 0};
  for (std::size_t i = powers_; i-- > 0;) {
    const Complex* p = &c_[i * terms_];
    Complex value = p[0], slope = 0;
    if (i > 0 && i + 1 < powers_) {
      value = p[terms_ - 1];
      for (std::size_t j = terms_ - 1; j-- > 0;) {
        slope = slope * t + value;
        value = value * t + p[j];
      }
    }
    out.f_z = out.f_z * u + out.f;
    out.f = out.f * u + value;
    out.f_kappa = out.f_kappa * u + slope;
  }
  out.f_z /= rho_;
  out.f_kappa /= disc_.radius;
  out.kk = kk_;
  out.kz = kz_ / rho_;
  out.zz = zz_ / (rho_ * rho_);
  return out;
}

// With u = z/rho, kappa = w (1 - rho u), u_theta = -i u, and the derivatives by u:
//   g_w = f_k (1 - rho u),  g_theta = i u X,  X = w rho f_k - f_u,
//   g_ww = f_kk (1 - rho u)^2,
//   g_wt = i u (rho f_k + (1 - rho u)(w rho f_kk - f_ku)),
//   g_tt = u X - u^2 (w^2 rho^2 f_kk - 2 w rho f_ku + f_uu).
Local Patch::at(const Box& box) const {
  const Complex u = std::polar(1.0, -box.theta), step = 1.0 - rho_ * u;
  const Point p = point(rho_ * u, box.w * step);
  const double wr = box.w * rho_;
  const Complex X = wr * p.f_kappa - rho_ * p.f_z;
  Local out{.g = p.f, .g_w = p.f_kappa * step, .g_theta = Complex(0, 1) * u * X};

  const double w = (std::abs(box.w) + box.w_half) * rho_;
  const double q = std::abs(step) + rho_ * box.theta_half;
  const double reach = box.w_half * q + std::abs(wr) * box.theta_half;  // of kappa
  const double most_f_k = std::abs(p.f_kappa) + kk_ * reach + kz_ * box.theta_half;
  const double most_X = std::abs(X) + (w * kk_ + kz_) * reach +
                        (w * kz_ + zz_) * box.theta_half + rho_ * box.w_half * most_f_k;
  out.ww = kk_ * q * q;
  out.wt = rho_ * most_f_k + q * (w * kk_ + kz_);
  out.tt = most_X + w * w * kk_ + 2 * w * kz_ + zz_;
  return out;
}

}  // namespace turnwright::milling
