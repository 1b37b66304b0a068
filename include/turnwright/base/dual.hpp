#pragma once
#include <array>
#include <cmath>
#include <type_traits>

#include "turnwright/base/interval.hpp"

namespace turnwright {

constexpr double sqr(double x) { return x * x; }
constexpr double mid(double x) { return x; }

/// A value with its gradient to N variables (forward-mode automatic differentiation).
/// V = double gives exact gradients, V = Interval encloses value and gradient over a box.
///
///     (u, u') (v, v') = (u v, u' v + u v'),   F(u)' = F'(u) u'
///
/// `min`, `max` and `branch` take the gradient of the side that applies, and the hull of
/// both gradients where an interval contains both sides.  That is a generalised gradient,
/// for which the mean value theorem of continuous functions with kinks holds.
template <class V, int N>
struct Dual {
  V v{};
  std::array<V, N> d{};

  Dual() = default;
  Dual(double value) : v(V(value)) {}  // NOLINT: a number is a constant
  Dual(V value, std::array<V, N> gradient) : v(value), d(gradient) {}
};

/// Whether T is a number, with or without a gradient, and not an enclosure.
template <class T>
inline constexpr bool is_point = std::is_floating_point_v<T>;
template <int N>
inline constexpr bool is_point<Dual<double, N>> = true;

/// The variable number i with value v.
template <class V, int N>
Dual<V, N> variable(V v, int i) {
  Dual<V, N> x;
  x.v = v;
  x.d[static_cast<std::size_t>(i)] = V(1.0);
  return x;
}

namespace detail {
template <class V, int N>
Dual<V, N> chain(const V& value, const V& slope, const Dual<V, N>& x) {
  Dual<V, N> r;
  r.v = value;
  for (int i = 0; i < N; ++i) r.d[i] = slope * x.d[i];
  return r;
}
}  // namespace detail

template <class V, int N>
Dual<V, N> operator-(const Dual<V, N>& a) {
  return detail::chain(-a.v, V(-1.0), a);
}
template <class V, int N>
Dual<V, N> operator+(const Dual<V, N>& a, const Dual<V, N>& b) {
  Dual<V, N> r;
  r.v = a.v + b.v;
  for (int i = 0; i < N; ++i) r.d[i] = a.d[i] + b.d[i];
  return r;
}
template <class V, int N>
Dual<V, N> operator-(const Dual<V, N>& a, const Dual<V, N>& b) {
  Dual<V, N> r;
  r.v = a.v - b.v;
  for (int i = 0; i < N; ++i) r.d[i] = a.d[i] - b.d[i];
  return r;
}
template <class V, int N>
Dual<V, N> operator*(const Dual<V, N>& a, const Dual<V, N>& b) {
  Dual<V, N> r;
  r.v = a.v * b.v;
  for (int i = 0; i < N; ++i) r.d[i] = a.d[i] * b.v + a.v * b.d[i];
  return r;
}
template <class V, int N>
Dual<V, N> operator/(const Dual<V, N>& a, const Dual<V, N>& b) {
  Dual<V, N> r;
  r.v = a.v / b.v;
  const V w = V(1.0) / b.v;
  for (int i = 0; i < N; ++i) r.d[i] = (a.d[i] - r.v * b.d[i]) * w;
  return r;
}
template <class V, int N>
Dual<V, N> operator+(const Dual<V, N>& a, double b) {
  Dual<V, N> r = a;
  r.v = r.v + V(b);
  return r;
}
template <class V, int N>
Dual<V, N> operator+(double a, const Dual<V, N>& b) {
  return b + a;
}
template <class V, int N>
Dual<V, N> operator-(const Dual<V, N>& a, double b) {
  return a + (-b);
}
template <class V, int N>
Dual<V, N> operator-(double a, const Dual<V, N>& b) {
  return -b + a;
}
template <class V, int N>
Dual<V, N> operator*(const Dual<V, N>& a, double b) {
  return detail::chain(a.v * V(b), V(b), a);
}
template <class V, int N>
Dual<V, N> operator*(double a, const Dual<V, N>& b) {
  return b * a;
}
template <class V, int N>
Dual<V, N> operator/(const Dual<V, N>& a, double b) {
  return a * (1.0 / b);
}
template <class V, int N>
Dual<V, N> operator/(double a, const Dual<V, N>& b) {
  return Dual<V, N>(a) / b;
}

template <class V, int N>
Dual<V, N> exp(const Dual<V, N>& x) {
  using std::exp;
  const V e = exp(x.v);
  return detail::chain(e, e, x);
}
template <class V, int N>
Dual<V, N> log(const Dual<V, N>& x) {
  using std::log;
  return detail::chain(V(log(x.v)), V(1.0) / x.v, x);
}
template <class V, int N>
Dual<V, N> sqrt(const Dual<V, N>& x) {
  using std::sqrt;
  const V s = sqrt(x.v);
  return detail::chain(s, V(0.5) / s, x);
}
template <class V, int N>
Dual<V, N> sin(const Dual<V, N>& x) {
  using std::cos;
  using std::sin;
  return detail::chain(V(sin(x.v)), V(cos(x.v)), x);
}
template <class V, int N>
Dual<V, N> cos(const Dual<V, N>& x) {
  using std::cos;
  using std::sin;
  return detail::chain(V(cos(x.v)), -V(sin(x.v)), x);
}
template <class V, int N>
Dual<V, N> acos(const Dual<V, N>& x) {
  using std::acos;
  using std::sqrt;
  return detail::chain(V(acos(x.v)), V(-1.0) / sqrt(V(1.0) - sqr(x.v)), x);
}
template <class V, int N>
Dual<V, N> pow(const Dual<V, N>& x, double p) {
  using std::pow;
  const V value = pow(x.v, p);
  if constexpr (std::is_floating_point_v<V>)
    if (x.v != 0) return detail::chain(value, V(p) * value / x.v, x);
  return detail::chain(value, V(p) * pow(x.v, p - 1), x);
}
template <class V, int N>
Dual<V, N> sqr(const Dual<V, N>& x) {
  return detail::chain(sqr(x.v), V(2.0) * x.v, x);
}

namespace detail {
template <int N>
Dual<Interval, N> merge(const Interval& value, const Dual<Interval, N>& a,
                        const Dual<Interval, N>& b) {
  Dual<Interval, N> r;
  r.v = value;
  for (int i = 0; i < N; ++i) r.d[i] = hull(a.d[i], b.d[i]);
  return r;
}
}  // namespace detail

template <int N>
Dual<double, N> min(const Dual<double, N>& a, const Dual<double, N>& b) {
  return a.v <= b.v ? a : b;
}
template <int N>
Dual<double, N> max(const Dual<double, N>& a, const Dual<double, N>& b) {
  return a.v >= b.v ? a : b;
}
template <int N>
Dual<Interval, N> min(const Dual<Interval, N>& a, const Dual<Interval, N>& b) {
  if (a.v.hi <= b.v.lo) return a;
  if (b.v.hi <= a.v.lo) return b;
  return detail::merge(min(a.v, b.v), a, b);
}
template <int N>
Dual<Interval, N> max(const Dual<Interval, N>& a, const Dual<Interval, N>& b) {
  if (a.v.lo >= b.v.hi) return a;
  if (b.v.lo >= a.v.hi) return b;
  return detail::merge(max(a.v, b.v), a, b);
}

/// below(x) where x <= at, above(x) where x >= at, for a function continuous there.
template <class Below, class Above>
double branch(double x, double at, const Below& below, const Above& above) {
  return x <= at ? below(x) : above(x);
}
template <int N, class Below, class Above>
Dual<double, N> branch(const Dual<double, N>& x, double at, const Below& below,
                       const Above& above) {
  return x.v <= at ? below(x) : above(x);
}
template <int N, class Below, class Above>
Dual<Interval, N> branch(const Dual<Interval, N>& x, double at, const Below& below,
                         const Above& above) {
  if (x.v.hi <= at) return below(x);
  if (x.v.lo >= at) return above(x);
  Dual<Interval, N> low = x, high = x;
  low.v.hi = at;
  high.v.lo = at;
  const auto a = below(low), b = above(high);
  return detail::merge(hull(a.v, b.v), a, b);
}

}  // namespace turnwright
