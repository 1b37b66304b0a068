#include "chain.hpp"

#include <algorithm>
#include <optional>

namespace turnwright::planning {
namespace {

using Box = Coefficients<Interval>;
using Point = Coefficients<double>;

// law over intervals of depth and feed, with its slopes along both.
struct Slopes {
  Interval law, depth, f;
  bool rising = false;  // with every coefficient
};

Slopes slopes(const Box& law, const cutting::Cut& cut, const Interval& depth,
              const Interval& f) {
  using L = LogDual<2>;
  const std::array<Interval, 2> y{log(depth), log(f)};
  const L::Half half{width(y[0]) / 2, width(y[1]) / 2};
  const L ap = L::variable(y[0], 0, half), feed = L::variable(y[1], 1, half);
  const Coefficients<Dual<Interval, 2>> c{
      {law.p, {}}, {law.q, {}}, {law.s, {}}, {law.r, {}}};
  const auto F = cutting::forces_N(cut, ap, feed);
  const auto e = law_mm<L>(c, F);
  // d F/d ap = G + d G/d ln ap of G = F/ap, which varies much less than F and ap.
  const auto G = cutting::forces_N(cut, ap, feed, ap);
  const auto slope = [](const Dual<Interval, 2>& g) { return g.v + g.d[0]; };
  const Interval Fc = slope(linear(G.Fc_N));
  const Interval gain = slope(G.Fp_N) * law.p + slope(linear(G.Ff_N)) * law.q +
                        Fc * law.s + Interval(2) * exp(F.Fc_N.ln) * Fc * law.r;
  return {e.v, gain, e.d[1] / f, F.Fp_N.v.lo >= 0};
}

// Ends of the intervals at which a monotone e is least or greatest.
double at_end(const Box& law, const cutting::Cut& cut, const Interval& full,
              const Interval& f, bool falls_with_full, bool falls_with_f, bool greatest) {
  const auto end = [&](const Interval& x, bool falls) {
    return falls != greatest ? x.hi : x.lo;
  };
  const Point c{end(law.p, false), end(law.q, false), end(law.s, false),
                end(law.r, false)};
  return yielding_mm(c, cut, end(full, falls_with_full), end(f, falls_with_f), 0);
}

// Least share of the full depth that is left to cut: nothing yields more than is cut.
constexpr double kLeast = 1e-6;

}  // namespace

namespace {
// Where little of the depth yields: e = law(full - e) lies in law over the depths that a
// guess of its range leaves, if that is inside the guess.
std::optional<Yielding> little_yielding(const Box& law, const cutting::Cut& cut,
                                        const Interval& full, const Interval& f) {
  const auto F = cutting::forces_N(cut, full.hi, f.hi);
  const double most = std::abs(F.Fp_N) * std::max(std::abs(law.p.lo), std::abs(law.p.hi)) +
                      F.Ff_N * std::max(std::abs(law.q.lo), std::abs(law.q.hi)) +
                      F.Fc_N * std::max(std::abs(law.s.lo), std::abs(law.s.hi)) +
                      sqr(F.Fc_N) * std::max(std::abs(law.r.lo), std::abs(law.r.hi));
  const double guess = 1.5 * most;
  if (!(guess < 0.3 * full.lo)) return {};
  const Slopes s = slopes(law, cut, full + Interval(-guess, guess), f);
  if (!(s.law.lo >= -guess && s.law.hi <= guess && s.depth.lo > -0.5)) return {};
  return Yielding{s.law, s.depth};
}
}  // namespace

// Starts from a range of e that holds every root and narrows it: to its ends where the
// slopes have one sign (there e is monotone), else by interval Newton, and before that
// has a slope to go by, by slices off the ends that hold no root.
Yielding yielding_range(const Box& law, const cutting::Cut& cut, const Interval& full,
                        const Interval& f) {
  constexpr int kSteps = 12;
  if (!(full.lo > 0)) return {};
  if (const auto near = little_yielding(law, cut, full, f)) return *near;
  const auto depths = [&](const Interval& e) {
    const double least = kLeast * full.lo;
    const Interval d = full - e;
    return Interval(std::max(d.lo, least), std::max(d.hi, least));
  };
  const Interval e0 = slopes(law, cut, full, f).law;
  // As in yielding_mm, G(e) = e - law(full - e) changes sign between these.
  Interval e(2 * std::min(e0.lo, 0.0), std::min(2 * std::max(e0.hi, 0.0), full.hi));
  if (e.lo < 0) {
    const Interval bottom = Interval(e.lo) - slopes(law, cut, full - Interval(e.lo), f).law;
    if (!(bottom.hi <= 0)) return {};
  }
  Interval gain;
  for (int step = 0; step < kSteps; ++step) {
    const double before = width(e);
    const Slopes s = slopes(law, cut, depths(e), f);
    gain = s.depth;
    if (gain.lo >= 0) e.hi = std::min(e.hi, std::max(e0.hi, 0.0));  // law falls with e
    if (gain.lo > -1) {
      const bool known = s.rising && (gain.lo >= 0 || gain.hi <= 0) &&
                         (s.f.lo >= 0 || s.f.hi <= 0);
      if (known) {
        const bool a = gain.lo < 0, b = s.f.lo < 0;
        e = intersect(e, {at_end(law, cut, full, f, a, b, false),
                          at_end(law, cut, full, f, a, b, true)});
        gain = intersect(gain, slopes(law, cut, depths(e), f).depth);
        return {e, gain};
      }
      const Interval m(mid(e)), slope = Interval(1) + gain;
      const Interval next =
          intersect(e, m - (m - slopes(law, cut, depths(m), f).law) / slope);
      if (next.lo <= next.hi) e = next;
    } else {
      const auto G = [&](const Interval& x) {
        return x - slopes(law, cut, depths(x), f).law;
      };
      for (double share = 0.25; share > 1e-3 && width(e) > 0.5 * before; share /= 4) {
        const double slice = share * before;
        while (e.hi - slice > e.lo && G({e.hi - slice, e.hi}).lo > 0) e.hi -= slice;
        while (e.lo + slice < e.hi && G({e.lo, e.lo + slice}).hi < 0) e.lo += slice;
      }
    }
    if (width(e) > 0.9 * before) break;
  }
  return {e, gain};
}

namespace {
Dual<double, 1> along_depth(const Point& law, const cutting::Cut& cut, double depth,
                            double f) {
  using D = Dual<double, 1>;
  return law_mm<D>({law.p, law.q, law.s, law.r},
                   cutting::forces_N(cut, variable<double, 1>(depth, 0), D(f)));
}
}  // namespace

double loop_gain(const Point& law, const cutting::Cut& cut, double depth, double f) {
  return along_depth(law, cut, depth, f).d[0];
}

double yielding_mm(const Point& law, const cutting::Cut& cut, double ap, double f,
                   double e_before) {
  const double full = ap + e_before;
  // G(e) = e - law(full - e) rises (the force grows with the depth), is <= 0 at the lower
  // and >= 0 at the upper end; near full depth nothing is cut, so e stays below it.
  const auto G = [&](double e) {
    const auto l = along_depth(law, cut, std::max(full - e, 1e-9 * full), f);
    return std::pair{e - l.v, 1 + l.d[0]};
  };
  const auto [value, slope] = G(0);
  const double first = -value;
  const double lower = 2 * std::min(0.0, first),
               upper = std::min(2 * std::max(0.0, first), full);
  if (lower == upper) return 0;
  std::uintmax_t steps = 50;
  return boost::math::tools::newton_raphson_iterate(
      G, first / std::max(1.0, slope), lower, upper, 52, steps);
}

}  // namespace turnwright::planning
