#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "turnwright/base/units.hpp"

namespace turnwright {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Closed interval [lo, hi]: arithmetic on it encloses the arithmetic of every pair of
/// members, so a function written once over a scalar type can be bounded over a box.
///
/// Results are not rounded outwards: each operation may be too narrow by one unit in the
/// last place.  A proof by intervals must leave a margin for that (the certificates of
/// optimise/ keep 2e-10 in logarithms, a thousand times the loss of a few hundred
/// operations).  Boost.Interval rounds outwards by switching the processor's rounding
/// mode, which costs ten times this arithmetic.
/// Where an operation is undefined on part of its argument (log, sqrt, pow below zero)
/// the values on the rest are enclosed; where infinities make the result unknown it is
/// the whole line.
struct Interval {
  double lo = 0, hi = 0;

  constexpr Interval() = default;
  constexpr explicit Interval(double v) : lo(v), hi(v) {}
  constexpr Interval(double l, double h) : lo(l), hi(h) {}

  static constexpr Interval whole() { return {-kInfinity, kInfinity}; }
};

constexpr double mid(const Interval& x) { return 0.5 * (x.lo + x.hi); }
constexpr double width(const Interval& x) { return x.hi - x.lo; }
constexpr Interval hull(const Interval& a, const Interval& b) {
  return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)};
}
/// Intersection of two intervals that overlap, such as two enclosures of one value.
constexpr Interval intersect(const Interval& a, const Interval& b) {
  return {std::max(a.lo, b.lo), std::min(a.hi, b.hi)};
}

constexpr Interval operator-(const Interval& a) { return {-a.hi, -a.lo}; }
constexpr Interval operator+(const Interval& a, const Interval& b) {
  return {a.lo + b.lo, a.hi + b.hi};
}
constexpr Interval operator-(const Interval& a, const Interval& b) {
  return {a.lo - b.hi, a.hi - b.lo};
}
constexpr Interval operator*(const Interval& a, const Interval& b) {
  const double p = a.lo * b.lo, q = a.lo * b.hi, r = a.hi * b.lo, s = a.hi * b.hi;
  const double sum = p + q + r + s;
  if (sum != sum) return Interval::whole();  // one product is 0 times infinity
  return {std::min(std::min(p, q), std::min(r, s)),
          std::max(std::max(p, q), std::max(r, s))};
}
/// The quotient is the whole line where the divisor contains zero.
constexpr Interval operator/(const Interval& a, const Interval& b) {
  if (!(b.lo > 0 || b.hi < 0)) return Interval::whole();
  return a * Interval{1 / b.hi, 1 / b.lo};
}

inline Interval exp(const Interval& x) { return {std::exp(x.lo), std::exp(x.hi)}; }
inline Interval log(const Interval& x) {
  return {std::log(std::max(x.lo, 0.0)), std::log(std::max(x.hi, 0.0))};
}
inline Interval sqrt(const Interval& x) {
  return {std::sqrt(std::max(x.lo, 0.0)), std::sqrt(std::max(x.hi, 0.0))};
}
/// Arc cosine, which falls on [-1, 1]; arguments beyond are clamped.
inline Interval acos(const Interval& x) {
  return {std::acos(std::clamp(x.hi, -1.0, 1.0)), std::acos(std::clamp(x.lo, -1.0, 1.0))};
}
inline Interval cos(const Interval& x) {
  const double first = std::ceil(x.lo / units::kPi), last = std::floor(x.hi / units::kPi);
  if (!(last - first < 1)) return {-1, 1};
  const double a = std::cos(x.lo), b = std::cos(x.hi);
  const Interval ends{std::min(a, b), std::max(a, b)};
  if (first > last) return ends;  // no extremum inside
  return std::fmod(first, 2) == 0 ? Interval{ends.lo, 1} : Interval{-1, ends.hi};
}
inline Interval sin(const Interval& x) {
  constexpr double kQuarter = units::kPi / 2;
  return cos(Interval{x.lo - kQuarter, x.hi - kQuarter});
}
/// x^p for x >= 0.
inline Interval pow(const Interval& x, double p) {
  const double a = std::pow(std::max(x.lo, 0.0), p), b = std::pow(std::max(x.hi, 0.0), p);
  return p >= 0 ? Interval{a, b} : Interval{b, a};
}
/// x^2, which is narrower than x * x where x changes sign.
constexpr Interval sqr(const Interval& x) {
  const double a = x.lo * x.lo, b = x.hi * x.hi;
  if (x.lo <= 0 && x.hi >= 0) return {0, std::max(a, b)};
  return {std::min(a, b), std::max(a, b)};
}
constexpr Interval min(const Interval& a, const Interval& b) {
  return {std::min(a.lo, b.lo), std::min(a.hi, b.hi)};
}
constexpr Interval max(const Interval& a, const Interval& b) {
  return {std::max(a.lo, b.lo), std::max(a.hi, b.hi)};
}

}  // namespace turnwright
