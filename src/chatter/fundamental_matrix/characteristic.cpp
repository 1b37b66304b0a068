#include "characteristic.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/language.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::chatter {
namespace {

constexpr double kProductGrowth = 6;  // ln of the digits that products may lose

constexpr std::size_t kWork = 30'000'000;  // entries of intervals evaluated: seconds

using Matrix = std::vector<Complex>;  // row by row

/// Phi of an interval by Horner's rule.
void evaluate(const SubArc& stretch, std::size_t entries, Complex kappa, Matrix& out) {
  const double* c = &stretch.coefficients[stretch.degree * entries];
  out.assign(c, c + entries);
  for (std::size_t j = stretch.degree; j-- > 0;) {
    c -= entries;
    for (std::size_t e = 0; e < entries; ++e) out[e] = out[e] * kappa + c[e];
  }
}

/// The number mantissa e^log.
struct Scaled {
  Complex mantissa = 1;
  double log = 0;
  void multiply(Complex x) {
    mantissa *= x;
    const double size = std::abs(mantissa.real()) + std::abs(mantissa.imag());
    if ((size > 1e100 || size < 1e-100) && size > 0) {
      mantissa /= size;
      log += std::log(size);
    }
  }
};

/// Gaussian elimination with row pivoting of the first `pivots` columns of `a`.  Returns
/// the product of the pivots with the sign of the row exchanges.
Scaled eliminate(Matrix& a, std::size_t rows, std::size_t columns, std::size_t pivots) {
  Scaled det;
  for (std::size_t k = 0; k < pivots; ++k) {
    std::size_t best = k;
    for (std::size_t r = k + 1; r < rows; ++r)
      if (std::norm(a[r * columns + k]) > std::norm(a[best * columns + k])) best = r;
    if (best != k) {
      std::swap_ranges(&a[k * columns + k], &a[k * columns] + columns,
                       &a[best * columns + k]);
      det.mantissa = -det.mantissa;
    }
    const Complex pivot = a[k * columns + k];
    det.multiply(pivot);
    if (pivot == 0.0) return det;
    const Complex inverse = 1.0 / pivot;
    for (std::size_t r = k + 1; r < rows; ++r) {
      const Complex factor = a[r * columns + k] * inverse;
      if (factor == 0.0) continue;
      for (std::size_t c = k + 1; c < columns; ++c)
        a[r * columns + c] -= factor * a[k * columns + c];
    }
  }
  return det;
}

/// The relation L u_0 + M u_K = 0 between the two ends of the period; pivots as in
/// `eliminate`.
struct Condensed {
  Matrix L, M;
  Scaled pivots;
};

Condensed condensed(const Propagator& p, Complex kappa) {
  const std::size_t m = p.states, entries = m * m;
  Condensed out;
  Matrix phi;
  evaluate(p.stretches.front(), entries, kappa, phi);
  for (Complex& x : phi) x = -x;
  out.L = phi;
  out.M.assign(entries, 0);
  for (std::size_t i = 0; i < m; ++i) out.M[i * m + i] = 1;
  Matrix work;
  for (std::size_t k = 1; k < p.stretches.size(); ++k) {
    evaluate(p.stretches[k], entries, kappa, phi);
    const std::size_t columns = 3 * m;  // u_k, u_0, u_(k+1)
    work.assign(2 * m * columns, 0);
    for (std::size_t r = 0; r < m; ++r) {
      for (std::size_t c = 0; c < m; ++c) {
        work[r * columns + c] = out.M[r * m + c];
        work[r * columns + m + c] = out.L[r * m + c];
        work[(m + r) * columns + c] = -phi[r * m + c];
      }
      work[(m + r) * columns + 2 * m + r] = 1;
    }
    const Scaled det = eliminate(work, 2 * m, columns, m);
    out.pivots.multiply(det.mantissa);
    out.pivots.log += det.log;
    for (std::size_t r = 0; r < m; ++r)
      for (std::size_t c = 0; c < m; ++c) {
        out.L[r * m + c] = work[(m + r) * columns + m + c];
        out.M[r * m + c] = work[(m + r) * columns + 2 * m + c];
      }
  }
  return out;
}

/// Phi of the whole period, and ln of the factor by which its rounding errors may have
/// grown.
struct Product {
  Matrix phi;
  double log_growth = 0;
};

double log_norm(const Matrix& a) {
  double sum = 0;
  for (const Complex& x : a) sum += std::norm(x);
  return std::log(std::max(sum, 1e-300)) / 2;
}

Product product(const Propagator& p, Complex kappa) {
  const std::size_t m = p.states;
  Product out;
  evaluate(p.stretches.front(), m * m, kappa, out.phi);
  Matrix next, product(m * m);
  double log_size = 0;
  for (std::size_t k = 1; k < p.stretches.size(); ++k) {
    evaluate(p.stretches[k], m * m, kappa, next);
    for (std::size_t r = 0; r < m; ++r)
      for (std::size_t c = 0; c < m; ++c) {
        Complex sum = 0;
        for (std::size_t i = 0; i < m; ++i) sum += next[r * m + i] * out.phi[i * m + c];
        product[r * m + c] = sum;
      }
    log_size += std::max(0.0, log_norm(next) - 0.5 * std::log(static_cast<double>(m)));
    out.phi.swap(product);
  }
  out.log_growth = std::max(log_size, log_norm(out.phi));
  return out;
}

Complex root_of_unity(std::size_t k, std::size_t n) {
  return std::polar(1.0,
                    2 * units::kPi * static_cast<double>(k) / static_cast<double>(n));
}

/// c_1 .. c_(m-1) from f at the m-th roots of unity, where c_0 and c_m add up.
void interpolate(const std::vector<Scaled>& f, Coefficients& out) {
  const std::size_t m = f.size();
  double log_scale = 0;
  for (const Scaled& x : f)
    if (x.mantissa != 0.0)
      log_scale = std::max(log_scale, x.log + std::log(std::abs(x.mantissa)));
  out.log_scale = log_scale < 100 ? 0 : log_scale;
  for (std::size_t i = 1; i < m; ++i) {
    Complex sum = 0;
    for (std::size_t s = 0; s < m; ++s)
      sum += f[s].mantissa * std::exp(f[s].log - out.log_scale) *
             std::conj(root_of_unity(i * s % m, m));
    out.c[i] = sum / static_cast<double>(m);
  }
}

}  // namespace

Characteristic::Characteristic(const System& system, double n_rpm,
                               const Resolution& resolution)
    : Characteristic(system, arc_loads(system, n_rpm), n_rpm, resolution) {}

Characteristic::Characteristic(const System& system, std::vector<ArcLoad> arcs,
                               double n_rpm, const Resolution& resolution)
    : system_(&system),
      arcs_(std::move(arcs)),
      n_rpm_(n_rpm),
      tau_s_(period_s(system, n_rpm)),
      resolution_(resolution) {}

const Propagator& Characteristic::propagator_for(double kappa_abs) const {
  for (const auto& [limit, made] : made_)
    if (kappa_abs <= limit) return *made;
  const double limit = made_.empty() ? kappa_abs * (1 + 1e-9)
                                     : std::max(2 * made_.back().first, kappa_abs);
  made_.emplace_back(limit, std::make_unique<Propagator>(
                                propagator(*system_, arcs_, n_rpm_, limit, resolution_)));
  return *made_.back().second;
}

Coefficients Characteristic::at(Complex kappa, double kappa_max) const {
  const Propagator& p = propagator_for(kappa_max);
  const std::size_t m = p.states;
  leave_if_asked();
  work_ += p.stretches.size() * m * m;
  if (work_ > kWork)
    throw TooManyVibrations(tr(
        "milling: the search takes too long; ask for a smaller depth or a higher speed"));
  Coefficients out;
  out.c.assign(m + 1, 0);
  Product whole = product(p, kappa);
  std::vector<Scaled> f;
  if (whole.log_growth < kProductGrowth) {
    if (m == 2) {
      out.c[1] = -(whole.phi[0] + whole.phi[3]);
    } else {
      for (std::size_t s = 0; s < m; ++s) {
        const Complex z = root_of_unity(s, m);
        Matrix a(m * m);
        for (std::size_t e = 0; e < m * m; ++e) a[e] = -z * whole.phi[e];
        for (std::size_t i = 0; i < m; ++i) a[i * m + i] += 1.0;
        f.push_back(eliminate(a, m, m, m));
      }
      interpolate(f, out);
    }
  } else {
    const Condensed ends = condensed(p, kappa);
    for (std::size_t s = 0; s < m; ++s) {
      const Complex z = root_of_unity(s, m);
      Matrix a(m * m);
      for (std::size_t e = 0; e < m * m; ++e) a[e] = z * ends.L[e] + ends.M[e];
      Scaled det = eliminate(a, m, m, m);
      det.multiply(ends.pivots.mantissa);
      det.log += ends.pivots.log;
      f.push_back(det);
    }
    interpolate(f, out);
  }
  out.c[0] = std::exp(-out.log_scale);
  out.c[m] = std::exp(p.log_det - out.log_scale);
  return out;
}

Complex Characteristic::value(Complex z, double w_mm) const {
  const Coefficients k = at(w_mm * (1.0 - z), w_mm * (1 + std::abs(z)));
  Complex sum = 0;
  for (std::size_t i = k.c.size(); i-- > 0;) sum = sum * z + k.c[i];
  return sum;
}

}  // namespace turnwright::chatter
