#pragma once
#include <cmath>

namespace turnwright {

/// A root of g in [low, high], where g(low) <= 0 <= g(high): Newton's steps, halving where
/// they leave the bracket; a bracket that begins at 0 is cut to its thousandth, as its
/// root may be of any size.  g need not be monotone, nor its slope finite at the ends.
/// @param g         g(x) -> pair of value and slope.
/// @param at        where to start, in [low, high].
/// @param relative  of x, the last step; halving alone reaches any double.
template <class G>
double bracketed_root(const G& g, double low, double high, double at, double relative) {
  for (int step = 0; step < 2200; ++step) {
    const auto [value, slope] = g(at);
    if (value == 0) return at;
    (value < 0 ? low : high) = at;
    double next = at - value / slope;
    if (!(next > low && next < high))
      next = low == 0 ? high / 1024 : low + (high - low) / 2;
    if (std::abs(next - at) <= relative * std::abs(next)) return next;
    at = next;
  }
  return at;
}

}  // namespace turnwright
