#include "propagator.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace turnwright::milling {
namespace {

constexpr double kDropped = 1e-17;  // terms of the series relative to Phi
constexpr std::size_t kDegree = 60;

/// q = kernel f, row by row with `columns` columns; kColumns the same if not 0.
template <std::size_t kColumns = 0>
void apply(const std::vector<double>& kernel, std::size_t columns,
           const std::vector<double>& f, std::vector<double>& q) {
  if constexpr (kColumns == 0) {
    if (columns == 2) return apply<2>(kernel, columns, f, q);
    if (columns == 4) return apply<4>(kernel, columns, f, q);
  }
  const std::size_t m = kColumns ? kColumns : columns, p = f.size() / m;
  std::fill(q.begin(), q.end(), 0.0);
  for (std::size_t i = 0; i < p; ++i) {
    const double* row = &kernel[i * p];
    double* sum = &q[i * m];
    for (std::size_t j = 0; j < p; ++j)
      for (std::size_t c = 0; c < m; ++c) sum[c] += row[j] * f[j * m + c];
  }
}

/// Neumann series of the stretches of one system.
class Expansion {
 public:
  Expansion(const System& system, const Stretches& stretches, double kappa_max)
      : system_(system),
        stretches_(stretches),
        kappa_max_(kappa_max),
        states_(2 * system.modes.size()) {}

  // Phi_0 = e^(A t), Phi_(j+1) = -int e^(A (t - s)) B Phi_j ds; Eq. (2).
  SubArc of(const Stretch& stretch) const {
    const Kernel& kernel = stretches_.kernels[stretch.kernel];
    const std::vector<Directional>& h = stretch.h;
    const std::size_t p = h.size(), m = states_, modes = system_.modes.size();
    SubArc out;
    out.coefficients.assign(m * m, 0);
    std::array<std::vector<double>, 2> q{std::vector<double>(p * m),
                                         std::vector<double>(p * m)};
    std::array<std::vector<double>, 2> force = q;
    for (std::size_t k = 0; k < modes; ++k) {
      const Transition whole = transition(system_.modes[k], kernel.length_s);
      double* block = &out.coefficients[2 * k * m + 2 * k];
      block[0] = whole.xx;
      block[1] = whole.xv;
      block[m] = whole.vx;
      block[m + 1] = whole.vv;
      for (std::size_t i = 0; i < p; ++i) {
        q[stretches_.axis_of[k]][i * m + 2 * k] = kernel.from_begin[k * p + i].xx;
        q[stretches_.axis_of[k]][i * m + 2 * k + 1] = kernel.from_begin[k * p + i].xv;
      }
    }
    double scale = 1;
    for (std::size_t degree = 1; degree <= kDegree; ++degree) {
      for (std::size_t i = 0; i < p; ++i)
        for (std::size_t c = 0; c < m; ++c) {
          const double x = q[0][i * m + c], y = q[1][i * m + c];
          force[0][i * m + c] = -(h[i].xx * x + h[i].xy * y);
          force[1][i * m + c] = -(h[i].yx * x + h[i].yy * y);
        }
      const double largest = append_end(kernel, force, out);
      out.degree = degree;
      scale *= kappa_max_;
      if (largest * scale < kDropped) break;
      for (std::size_t a = 0; a < 2; ++a)
        if (stretches_.used[a]) apply(kernel.axis[a], m, force[a], q[a]);
    }
    if (stretch.flight_s > 0) fly(stretch.flight_s, out);
    return out;
  }

 private:
  /// Adds the next coefficient, the integral to the end of the stretch; returns its
  /// largest entry.
  double append_end(const Kernel& kernel, const std::array<std::vector<double>, 2>& force,
                    SubArc& out) const {
    const std::size_t p = kernel.t_s.size(), m = states_, at = out.coefficients.size();
    out.coefficients.resize(at + m * m, 0);
    for (std::size_t k = 0; k < system_.modes.size(); ++k) {
      const Mode& mode = system_.modes[k];
      double* row = &out.coefficients[at + 2 * k * m];
      const auto& f = force[stretches_.axis_of[k]];
      for (std::size_t i = 0; i < p; ++i) {
        const double weight = kernel.weight_s[i] * mode.wn_rad_s / mode.k_N_mm;
        const Transition& end = kernel.to_end[k * p + i];
        for (std::size_t c = 0; c < m; ++c) {
          row[c] += weight * end.xv * f[i * m + c];
          row[m + c] += weight * end.vv * f[i * m + c];
        }
      }
    }
    double largest = 0;
    for (std::size_t e = at; e < out.coefficients.size(); ++e)
      largest = std::max(largest, std::abs(out.coefficients[e]));
    return largest;
  }

  // A free flight in closed form, after the stretch.
  void fly(double length, SubArc& last) const {
    const std::size_t m = states_;
    for (std::size_t k = 0; k < system_.modes.size(); ++k) {
      const Transition free = transition(system_.modes[k], length);
      for (std::size_t j = 0; j <= last.degree; ++j) {
        double* row = &last.coefficients[j * m * m + 2 * k * m];
        for (std::size_t c = 0; c < m; ++c) {
          const double x = row[c], v = row[m + c];
          row[c] = free.xx * x + free.xv * v;
          row[m + c] = free.vx * x + free.vv * v;
        }
      }
    }
  }

  const System& system_;
  const Stretches& stretches_;
  double kappa_max_;
  std::size_t states_;
};

}  // namespace

Propagator propagator(const System& system, const std::vector<ArcLoad>& arcs,
                      double n_rpm, double kappa_max_mm, const Resolution& resolution) {
  Propagator out;
  out.states = 2 * system.modes.size();
  for (const Mode& m : system.modes)
    out.log_det -= 2 * m.zeta * m.wn_rad_s * period_s(system, n_rpm);
  const Stretches cut = stretches(system, arcs, n_rpm, kappa_max_mm, resolution);
  const Expansion expansion(system, cut, kappa_max_mm);
  for (const Stretch& stretch : cut.all) out.stretches.push_back(expansion.of(stretch));
  return out;
}

}  // namespace turnwright::milling
