#pragma once
#include <array>
#include <cmath>
#include <limits>

#include "turnwright/base/dual.hpp"

namespace turnwright {

/// Encloses a positive quantity over a box of logarithms y: ln of its value, and its
/// elasticities d ln(value)/dy.
///
///     (u v)' = u' + v',  (u^p)' = p u',  (u + v)' = u' + w (v' - u'),  w = v/(u + v) (1)
///
/// so a product of powers is enclosed without error on any box, and the gradient of a sum
/// is a weighted mean of the gradients of its terms.  The gradient of a cost or a force
/// therefore stays within the hull of its exponents, where Dual<Interval> would multiply
/// and divide the widths of its values.  With the value at the middle of the box,
/// `centre`, every result is also
///
///     ln v in centre + sum_j (elasticity_j) [-h_j, h_j],  h the box's half widths    (2)
///
/// Rounding is that of Interval.  Zero has ln v = -infinity and is neutral under +.
/// Source: derived here; log_dual_test samples boxes.
template <int N>
struct LogDual {
  using Gradient = std::array<Interval, N>;
  using Half = std::array<double, N>;

  Interval ln;
  double centre = 0;  ///< ln at the middle of the box; NaN: unknown, (2) is not used
  Gradient d{};
  const Half* half = nullptr;  ///< half widths of the box, which must outlive the number

  LogDual() = default;   ///< one
  LogDual(double value)  // NOLINT: a number is a constant
      : centre(std::log(value)) {
    ln = Interval(centre);
  }

  /// exp(y_i) of variable number i over its interval.
  static LogDual variable(const Interval& y, int i, const Half& half) {
    LogDual x(1.0);
    x.ln = y;
    x.centre = mid(y);
    x.d[static_cast<std::size_t>(i)] = Interval(1.0);
    x.half = &half;
    return x;
  }
  bool constant() const {
    if (half || ln.lo != ln.hi) return false;
    for (const Interval& e : d)
      if (e.lo != 0 || e.hi != 0) return false;
    return true;
  }
  bool zero() const { return ln.hi == -std::numeric_limits<double>::infinity(); }
};

/// The scalar type for quantities of either sign in computations with T: Dual<Interval>
/// for LogDual, which can only be positive, and T itself otherwise.
template <class T>
struct SignedOf {
  using Type = T;
};
template <int N>
struct SignedOf<LogDual<N>> {
  using Type = Dual<Interval, N>;
};
template <class T>
using Signed = typename SignedOf<T>::Type;

namespace detail {
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

template <int N>
double reach(const std::array<Interval, N>& d, const std::array<double, N>* half) {
  double r = 0;
  if (half)
    for (std::size_t j = 0; j < N; ++j)
      if ((*half)[j] > 0)
        r += std::max(std::abs(d[j].lo), std::abs(d[j].hi)) * (*half)[j];
  return r;
}
// Narrows ln by (2), unless the centre is unknown.
template <int N>
LogDual<N> centred(LogDual<N> x) {
  const double r = reach<N>(x.d, x.half);
  if (x.centre - r > x.ln.lo) x.ln.lo = x.centre - r;
  if (x.centre + r < x.ln.hi) x.ln.hi = x.centre + r;
  return x;
}
// x exp(c): every bound of ln x is shifted by c.
template <int N>
LogDual<N> scaled(LogDual<N> x, double c) {
  x.ln = {x.ln.lo + c, x.ln.hi + c};
  x.centre += c;
  return x;
}
template <int N>
const std::array<double, N>* box_of(const LogDual<N>& a, const LogDual<N>& b) {
  return a.half ? a.half : b.half;
}
}  // namespace detail

template <int N>
LogDual<N> operator*(const LogDual<N>& a, const LogDual<N>& b) {
  if (b.constant()) return detail::scaled(a, b.ln.lo);
  LogDual<N> r;
  r.ln = a.ln + b.ln;
  r.centre = a.centre + b.centre;
  r.half = detail::box_of(a, b);
  for (std::size_t j = 0; j < N; ++j) r.d[j] = a.d[j] + b.d[j];
  return detail::centred(r);
}
template <int N>
LogDual<N> operator/(const LogDual<N>& a, const LogDual<N>& b) {
  if (b.constant()) return detail::scaled(a, -b.ln.lo);
  LogDual<N> r;
  r.ln = a.ln - b.ln;
  r.centre = a.centre - b.centre;
  r.half = detail::box_of(a, b);
  for (std::size_t j = 0; j < N; ++j) r.d[j] = a.d[j] - b.d[j];
  return detail::centred(r);
}
template <int N>
LogDual<N> pow(const LogDual<N>& x, double p) {
  LogDual<N> r = x;
  r.ln = x.ln * Interval(p);
  r.centre = x.centre * p;
  for (std::size_t j = 0; j < N; ++j) r.d[j] = x.d[j] * Interval(p);
  return r;
}
template <int N>
LogDual<N> sqrt(const LogDual<N>& x) {
  return pow(x, 0.5);
}
template <int N>
LogDual<N> sqr(const LogDual<N>& x) {
  return pow(x, 2.0);
}

/// Eq. (1), with the weight w of b from ln(b/a).
template <int N>
LogDual<N> operator+(const LogDual<N>& a, const LogDual<N>& b) {
  if (a.zero()) return b;
  if (b.zero()) return a;
  const LogDual<N> q = b / a;
  const Interval w(1 / (1 + std::exp(-q.ln.lo)), 1 / (1 + std::exp(-q.ln.hi)));
  LogDual<N> r;
  r.half = q.half;
  for (std::size_t j = 0; j < N; ++j)
    r.d[j] = intersect(a.d[j] + w * (b.d[j] - a.d[j]), hull(a.d[j], b.d[j]));
  r.ln = {a.ln.lo + std::log1p(std::exp(b.ln.lo - a.ln.lo)),
          a.ln.hi + std::log1p(std::exp(b.ln.hi - a.ln.hi))};
  r.centre = a.centre + std::log1p(std::exp(q.centre));
  return detail::centred(r);
}

/// max(a - b, least), least > 0.
template <int N>
LogDual<N> difference(const LogDual<N>& a, const LogDual<N>& b, double least) {
  if (b.zero()) return a;
  const LogDual<N> q = b / a;
  const LogDual<N> floor = LogDual<N>(least) / a;
  // b/a where the difference is above its floor.
  const double most = 1 - std::exp(floor.ln.lo);
  const double high = std::min(std::exp(q.ln.hi), most);
  const double low = std::min(std::exp(q.ln.lo), most);
  if (low >= 1) return LogDual<N>(least);  // never above it
  const bool held = std::exp(q.ln.hi) + std::exp(floor.ln.hi) > 1;
  LogDual<N> r;
  r.half = q.half;
  const Interval k(low / (1 - low), high / (1 - high));
  for (std::size_t j = 0; j < N; ++j) {
    r.d[j] = a.d[j] + k * (a.d[j] - b.d[j]);
    if (held) r.d[j] = hull(r.d[j], Interval(0));
  }
  const auto at = [&](double ln_a, double ln_b) {
    return std::log(std::max(std::exp(ln_a) - std::exp(ln_b), least));
  };
  r.ln = {at(a.ln.lo, b.ln.hi), at(a.ln.hi, b.ln.lo)};
  r.centre = at(a.centre, b.centre);
  return detail::centred(r);
}
template <class T>
T difference(const T& a, const T& b, double least) {
  using std::max;
  return max(T(a - b), T(least));
}
/// a - b where that is positive by construction.
template <int N>
LogDual<N> operator-(const LogDual<N>& a, const LogDual<N>& b) {
  return difference(a, b, std::numeric_limits<double>::min());
}

template <int N>
LogDual<N> max(const LogDual<N>& a, const LogDual<N>& b) {
  if (a.zero()) return b;
  if (b.zero()) return a;
  const LogDual<N> q = b / a;
  if (q.ln.hi <= 0) return a;
  if (q.ln.lo >= 0) return b;
  LogDual<N> r;
  r.half = q.half;
  for (std::size_t j = 0; j < N; ++j) r.d[j] = hull(a.d[j], b.d[j]);
  r.ln = max(a.ln, b.ln);
  r.centre = a.centre + std::max(q.centre, 0.0);
  return detail::centred(r);
}
template <int N>
LogDual<N> min(const LogDual<N>& a, const LogDual<N>& b) {
  const LogDual<N> q = b / a;
  if (q.ln.hi <= 0) return b;
  if (q.ln.lo >= 0) return a;
  LogDual<N> r;
  r.half = q.half;
  for (std::size_t j = 0; j < N; ++j) r.d[j] = hull(a.d[j], b.d[j]);
  r.ln = min(a.ln, b.ln);
  r.centre = a.centre + std::min(q.centre, 0.0);
  return detail::centred(r);
}

template <int N>
LogDual<N> operator*(double a, const LogDual<N>& b) {
  return detail::scaled(b, std::log(a));
}
template <int N>
LogDual<N> operator*(const LogDual<N>& a, double b) {
  return b * a;
}
template <int N>
LogDual<N> operator/(const LogDual<N>& a, double b) {
  return (1 / b) * a;
}
template <int N>
LogDual<N> operator/(double a, const LogDual<N>& b) {
  return LogDual<N>(a) / b;
}
template <int N>
LogDual<N> operator+(const LogDual<N>& a, double b) {
  return a + LogDual<N>(b);
}
template <int N>
LogDual<N> operator+(double a, const LogDual<N>& b) {
  return LogDual<N>(a) + b;
}

/// A monotone function of x, given by ln of its value and by its elasticity over ln x.
template <int N, class Value, class Elasticity>
LogDual<N> monotone(const LogDual<N>& x, const Value& ln_value, const Elasticity& slope) {
  LogDual<N> r = x;
  const double a = ln_value(x.ln.lo), b = ln_value(x.ln.hi);
  r.ln = {std::min(a, b), std::max(a, b)};
  r.centre = ln_value(x.centre);
  const Interval s = slope(x.ln);
  for (std::size_t j = 0; j < N; ++j) r.d[j] = s * x.d[j];
  return detail::centred(r);
}

/// As `branch` of Dual.  Each side is enclosed over its own part of the box, to which (2)
/// does not apply.
template <int N, class Below, class Above>
LogDual<N> branch(const LogDual<N>& x, double at, const Below& below,
                  const Above& above) {
  const double edge = std::log(at);
  if (x.ln.hi <= edge) return below(x);
  if (x.ln.lo >= edge) return above(x);
  LogDual<N> low = x, high = x, middle;  // `middle` is the centre that (2) needs
  low.ln.hi = high.ln.lo = edge;
  low.centre = high.centre = detail::kUnknown;
  middle.ln = Interval(x.centre);
  middle.centre = x.centre;
  const LogDual<N> a = below(low), b = above(high);
  LogDual<N> r;
  r.half = x.half;
  r.ln = hull(a.ln, b.ln);
  for (std::size_t j = 0; j < N; ++j) r.d[j] = hull(a.d[j], b.d[j]);
  r.centre = std::isnan(x.centre)
                 ? x.centre
                 : (x.centre <= edge ? below(middle) : above(middle)).centre;
  return detail::centred(r);
}

/// Converts to the scalar type for quantities of either sign, and `positive` converts
/// back, for x.v.lo > 0.
template <int N>
Dual<Interval, N> linear(const LogDual<N>& x) {
  Dual<Interval, N> r;
  r.v = exp(x.ln);
  for (std::size_t j = 0; j < N; ++j) r.d[j] = r.v * x.d[j];
  return r;
}
template <class T>
T linear(const T& x) {
  return x;
}
template <int N>
LogDual<N> positive(const Dual<Interval, N>& x) {
  LogDual<N> r;
  r.ln = log(x.v);
  r.centre = detail::kUnknown;
  for (std::size_t j = 0; j < N; ++j) r.d[j] = x.d[j] / x.v;
  return r;
}
/// ln x with its gradient.
template <int N>
Dual<Interval, N> log(const LogDual<N>& x) {
  return {x.ln, x.d};
}

}  // namespace turnwright
