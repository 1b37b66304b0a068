#include "propagator.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace turnwright::chatter {
namespace {

constexpr double kDroppedTerm = 1e-17;  // terms of the series relative to Phi
constexpr std::size_t kDegree = 60;

/// out = matrix f for a matrix of `rows` rows, stored column by column, and f row by row
/// with M columns.  kRows rows are computed at a time, so that their sums are
/// independent.
template <std::size_t M, std::size_t kRows>
void multiply(const double* matrix, std::size_t rows, std::span<const double> f,
              double* out) {
  const std::size_t p = f.size() / M;
  for (std::size_t first = 0; first < rows; first += kRows) {
    const std::size_t i =
        std::min(first, rows - kRows);  // the last rows may be done twice
    double sum[M][kRows] = {};
    for (std::size_t j = 0; j < p; ++j)
      for (std::size_t c = 0; c < M; ++c)
        for (std::size_t r = 0; r < kRows; ++r)
          sum[c][r] += matrix[j * rows + i + r] * f[j * M + c];
    for (std::size_t r = 0; r < kRows; ++r)
      for (std::size_t c = 0; c < M; ++c) out[(i + r) * M + c] = sum[c][r];
  }
}

/// The same for any number of columns and at least two rows.
void multiply(const double* matrix, std::size_t rows, std::size_t columns,
              std::span<const double> f, double* out) {
  if (columns == 2 && rows >= 4) return multiply<2, 4>(matrix, rows, f, out);
  if (columns == 2) return multiply<2, 2>(matrix, rows, f, out);
  if (columns == 4) return multiply<4, 4>(matrix, rows, f, out);
  std::fill_n(out, rows * columns, 0.0);
  for (std::size_t j = 0; j < f.size() / columns; ++j)
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t c = 0; c < columns; ++c)
        out[i * columns + c] += matrix[j * rows + i] * f[j * columns + c];
}

/// Neumann series of the intervals of one system.
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
    std::vector<double> q(2 * p * m, 0), force = q;  // of x, then of y
    for (std::size_t k = 0; k < modes; ++k) {
      const Transition whole = transition(system_.modes[k], kernel.length_s);
      double* block = &out.coefficients[2 * k * m + 2 * k];
      block[0] = whole.xx;
      block[1] = whole.xv;
      block[m] = whole.vx;
      block[m + 1] = whole.vv;
      double* free = &q[stretches_.axis_of[k] * p * m + 2 * k];
      for (std::size_t i = 0; i < p; ++i, free += m) {
        free[0] = kernel.from_begin[k * p + i].xx;
        free[1] = kernel.from_begin[k * p + i].xv;
      }
    }
    // An axis without a mode does not move, and a force along it has no effect.
    const std::size_t from = stretches_.used[0] ? 0 : p,
                      to = stretches_.used[1] ? 2 * p : p;
    const std::span moving(&force[from * m], (to - from) * m);
    double scale = 1;
    for (std::size_t degree = 1; degree <= kDegree; ++degree) {
      for (std::size_t i = 0; i < p; ++i)
        for (std::size_t c = i * m; c < (i + 1) * m; ++c) {
          const double x = q[c], y = q[p * m + c];
          force[c] = -(h[i].xx * x + h[i].xy * y);
          force[p * m + c] = -(h[i].yx * x + h[i].yy * y);
        }
      out.coefficients.resize((degree + 1) * m * m);
      double* end = &out.coefficients[degree * m * m];
      multiply(&kernel.end[from * m], m, m, moving, end);
      out.degree = degree;
      scale *= kappa_max_;
      double largest = 0;
      for (std::size_t e = 0; e < m * m; ++e)
        largest = std::max(largest, std::abs(end[e]));
      if (largest * scale < kDroppedTerm) break;
      for (std::size_t a = 0; a < 2; ++a)
        if (stretches_.used[a])
          multiply(kernel.axis[a].data(), p, m, std::span(&force[a * p * m], p * m),
                   &q[a * p * m]);
    }
    if (stretch.flight_s > 0) fly(stretch.flight_s, out);
    return out;
  }

 private:
  // Free vibration after the interval, in closed form.
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

}  // namespace turnwright::chatter
