#include "turnwright/deflection/thrust.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace turnwright::deflection {
namespace {

struct Place {
  double z, share;  // middle of a part of the length, the part
  double m0, h;     // Eq. (1), without root
};

std::vector<Place> places(const part::Shaft& shaft, const Beam& beam) {
  const double L = beam.length_mm();
  const std::vector<double> z = part::ends_mm(shaft.segments);
  std::vector<Place> all;
  for (std::size_t i = 0; i + 1 < z.size(); ++i) {
    const double length = z[i + 1] - z[i];
    const int parts = std::max(16, static_cast<int>(std::ceil(160 * length / L)));
    for (int k = 0; k < parts; ++k) {
      const double x = z[i] + length * (k + 0.5) / parts;
      const Flexibility f = beam.at(x, {Method::chuck, {}, 0, 0});
      all.push_back(
          {x, length / parts, f.f_pp_rad_Nmm, f.f_wp_rad_N + (L - x) * f.f_pp_rad_Nmm});
    }
  }
  return all;
}

/// K as m0(min(x, y)) + k (p(x) + p(y)) + r + s p(x) p(y).
struct Kernel {
  double k = 0, r = 0, s = 0;
  std::vector<double> p;
};

Kernel kernel(const std::vector<Place>& at, const Beam& beam, const Supports& supports) {
  const double L = beam.length_mm(), c_t = supports.tail_mm_N;
  Kernel K;
  if (supports.method == Method::between_centres) {
    const double h_LL = beam.at(L, {Method::chuck, {}, 0, 0}).f_ww_mm_N;
    K.k = -1 / L;
    K.r = (h_LL + supports.head_mm_N + c_t) / (L * L);
    for (const Place& x : at) K.p.push_back(x.h);
  } else {
    const auto [c0, c1, c2] = supports.root;
    K.r = c2;
    K.s = -1 / (beam.at(L, {Method::chuck, supports.root, 0, 0}).f_ww_mm_N + c_t);
    for (const Place& x : at) K.p.push_back(x.h + c1 + c2 * L);
  }
  return K;
}

/// K times a slope, O(n): m0(min) from both sides, the rest of rank two.
std::vector<double> applied(const std::vector<Place>& at, const Kernel& K,
                            const std::vector<double>& slope) {
  const std::size_t n = at.size();
  std::vector<double> out(n);
  double sum = 0, weighted = 0, below = 0;
  for (std::size_t i = 0; i < n; ++i) {
    sum += at[i].share * slope[i];
    weighted += at[i].share * K.p[i] * slope[i];
  }
  double above = sum;
  for (std::size_t i = 0; i < n; ++i) {
    out[i] = below + at[i].m0 * above + K.k * (K.p[i] * sum + weighted) + K.r * sum +
             K.s * K.p[i] * weighted;
    below += at[i].share * at[i].m0 * slope[i];
    above -= at[i].share * slope[i];
  }
  return out;
}

}  // namespace

double critical_thrust_N(const part::Shaft& shaft, const Supports& supports) {
  if (supports.method == Method::chuck)
    throw std::domain_error("critical_thrust: a chuck alone takes no thrust");
  const Beam beam(shaft);
  const std::vector<Place> at = places(shaft, beam);
  const Kernel K = kernel(at, beam, supports);
  // Power iteration from the slope of a half wave; the critical loads of the modes differ
  // by a factor of two and more, so 60 steps converge to rounding.
  std::vector<double> slope;
  for (const Place& x : at) slope.push_back(std::cos(3 * x.z / beam.length_mm()));
  double eigenvalue = 0;
  for (int step = 0; step < 60; ++step) {
    std::vector<double> next = applied(at, K, slope);
    double product = 0, square = 0, size = 0;
    for (std::size_t i = 0; i < at.size(); ++i) {
      product += at[i].share * next[i] * slope[i];
      square += at[i].share * slope[i] * slope[i];
      size = std::max(size, std::abs(next[i]));
    }
    eigenvalue = product / square;
    for (double& x : next) x /= size;
    slope = std::move(next);
  }
  return 1 / eigenvalue;
}

double thrust_amplification(double P_N, double P_cr_N) {
  if (!(P_N >= 0 && P_N < P_cr_N))
    throw std::domain_error("thrust_amplification: P must be in [0, P_cr)");
  return 1 / (1 - P_N / P_cr_N);  // Eq. (3)
}

}  // namespace turnwright::deflection
