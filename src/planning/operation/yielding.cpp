#include "yielding.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "turnwright/base/root.hpp"

namespace turnwright::planning {
namespace {

using Box = Coefficients<Interval>;
using Point = Coefficients<double>;

// law over intervals of depth and feed, with its slope along the depth.
struct Slopes {
  Interval law, depth;
};

Interval law_over(const Box& law, const cutting::Forces<LogDual<2>>& F) {
  return law_mm<LogDual<2>>({{law.p, {}}, {law.q, {}}, {law.s, {}}, {law.r, {}}}, F).v;
}
Interval law_over(const Box& law, const cutting::Cut& cut, const Interval& depth,
                  const Interval& f) {
  const DepthAndFeed at(depth, f);
  return law_over(law, cutting::forces_N(cut, at.ap, at.f));
}

Slopes slopes(const Box& law, const cutting::Cut& cut, const Interval& depth,
              const Interval& f) {
  const DepthAndFeed at(depth, f);
  const auto F = cutting::forces_N(cut, at.ap, at.f);
  // d F/d ap = G + d G/d ln ap of G = F/ap, which varies much less than F and ap.
  const auto G = cutting::forces_N(cut, at.ap, at.f, at.ap);
  const auto slope = [](const Dual<Interval, 2>& g) { return g.v + g.d[0]; };
  const Interval Fc = slope(linear(G.Fc_N));
  const Interval gain = slope(G.Fp_N) * law.p + slope(linear(G.Ff_N)) * law.q +
                        Fc * law.s + Interval(2) * exp(F.Fc_N.ln) * Fc * law.r;
  return {law_over(law, F), gain};
}

// For a small yielding: if law maps the depths full - e, for all e in a guessed range,
// into that range, the root e = law(full - e) lies in the image.
std::optional<Yielding> little_yielding(const Box& law, const cutting::Cut& cut,
                                        const Interval& full, const Interval& f) {
  const auto size = [](const Interval& x) {
    return std::max(std::abs(x.lo), std::abs(x.hi));
  };
  const auto F = cutting::forces_N(cut, full.hi, f.hi);
  const double guess = 1.5 * (std::abs(F.Fp_N) * size(law.p) + F.Ff_N * size(law.q) +
                              F.Fc_N * size(law.s) + sqr(F.Fc_N) * size(law.r));
  if (!(guess < 0.3 * full.lo)) return {};
  const Interval depth = full + Interval(-guess, guess);
  const Slopes s = slopes(law, cut, depth, f);
  if (!(s.law.lo >= -guess && s.law.hi <= guess && s.depth.lo > -0.5)) return {};
  return Yielding{s.law, full - s.law, s.depth};
}

// Whether d + law(d) differs from full over all of [low, high], shown part by part.
bool no_root(const Box& law, const cutting::Cut& cut, const Interval& full,
             const Interval& f, double low, double high) {
  constexpr double kPart = 1.4, kRest = 0.1;  // of the upper end
  while (high > low) {
    const double from = high < kRest * full.lo ? low : std::max(low, high / kPart);
    const Interval law_there = law_over(law, cut, {from, high}, f);
    if (!(from + law_there.lo > full.hi || high + law_there.hi < full.lo)) return false;
    high = from;
  }
  return true;
}

// A range of depth that contains every root of d + law(d) = full that yielding_mm can
// find. It lies around the roots at the ends of the intervals and is proved by the
// absence of roots beyond it; empty if that proof fails.
Interval bracket(const Box& law, const cutting::Cut& cut, const Interval& full,
                 const Interval& f) {
  const auto root = [&](const Point& c, double whole, double feed) {
    return whole - yielding_mm(c, cut, whole, feed, 0);
  };
  const double deep = root({law.p.lo, law.q.lo, law.s.lo, law.r.lo}, full.hi, f.lo);
  const double shallow = root({law.p.hi, law.q.hi, law.s.hi, law.r.hi}, full.lo, f.hi);
  const double pulled = -2 * std::min(0.0, law_over(law, cut, full, f).lo);
  for (const double wider : {1.02, 1.2, 2.0}) {
    const Interval at(std::min(deep, shallow) / wider, std::max(deep, shallow) * wider);
    if (at.lo > 0 && no_root(law, cut, full, f, 1e-9 * full.lo, at.lo) &&
        no_root(law, cut, full, f, at.hi, full.hi + pulled))
      return at;
  }
  return {1, 0};
}

}  // namespace

// Solved for the depth that is really cut, which works for any width of `full`.
Yielding yielding_range(const Box& law, const cutting::Cut& cut, const Interval& full,
                        const Interval& f) {
  constexpr int kSteps = 4;
  if (!(full.lo > 0)) return {};
  if (const auto near = little_yielding(law, cut, full, f)) return *near;
  Interval d = bracket(law, cut, full, f);
  if (!(d.lo <= d.hi)) return {};
  Slopes s = slopes(law, cut, d, f);
  for (int step = 0; step < kSteps && s.depth.lo > -1; ++step) {  // interval Newton
    const double before = width(d);
    const Interval m(mid(d));
    const Interval H = m + law_over(law, cut, m, f) - full;
    const Interval next = intersect(d, m - H / (Interval(1) + s.depth));
    if (!(next.lo <= next.hi)) break;
    d = next;
    s = slopes(law, cut, d, f);
    if (width(d) > 0.8 * before) break;
  }
  return {intersect(s.law, full - d), d, s.depth};
}

namespace {
Dual<double, 1> along_depth(const Point& law, const cutting::Cut& cut, double depth,
                            double f) {
  using D = Dual<double, 1>;
  return law_mm<D>({law.p, law.q, law.s, law.r},
                   cutting::forces_N(cut, variable<double, 1>(depth, 0), D(f)));
}

constexpr double kDigits = 0x1p-29;  // of the last step; the root has twice as many
constexpr double kWithoutEnd = 100;  // in depths; no tolerance allows so much
}  // namespace

double loop_gain(const Point& law, const cutting::Cut& cut, double depth, double f) {
  return along_depth(law, cut, depth, f).d[0];
}

double yielding_mm(const Point& law, const cutting::Cut& cut, double ap, double f,
                   double e_before) {
  const double full = ap + e_before;
  if (!(full > 0)) return full;  // a tool that does not reach the surface changes nothing
  const auto G = [&](double e) {
    const auto l = along_depth(law, cut, std::max(full - e, 1e-9 * full), f);
    return std::pair{e - l.v, 1 + l.d[0]};
  };
  const auto [value, slope] = G(0);
  const double first = -value;
  if (first == 0) return 0;
  const double lower = 2 * std::min(0.0, first), upper = first > 0 ? full : 0;
  const double start = std::min(first / std::max(1.0, slope), full);
  // If the law has terms of both signs, G need not be monotone between its ends.
  if (first < 0 && G(lower).first > 0) return -kWithoutEnd * full;
  return bracketed_root(G, lower, upper, start, kDigits);
}

}  // namespace turnwright::planning
