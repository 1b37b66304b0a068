#pragma once
#include <cmath>

namespace turnwright {

/// A root of g in [low, high], where g(low) <= 0 <= g(high), by Newton's method; steps
/// that leave the bracket are replaced by bisection.  A bracket that begins at 0 is cut
/// to a thousandth instead, because its root may have any order of magnitude.  g need not
/// be monotone, nor its slope finite at the ends.
/// @param g         g(x) -> pair of value and slope.
/// @param at        starting point in [low, high].
/// @param relative  the search ends once a step is smaller than this share of x.
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
