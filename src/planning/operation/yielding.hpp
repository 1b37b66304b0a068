#pragma once
#include <array>

#include "operation_model.hpp"

/// Errors of a surface that yields under the cutting forces, with the feedback of the
/// depth of cut.
namespace turnwright::planning {

/// Error of the surface from the forces at one position and pass:
///
///     e = p Fp + q Ff + s Fc + r Fc^2                                                (1)
///
/// Turning: p = f_ww + c_rr, q = -+ f_wp D/2, s = c_rt, r = f_ww,t^2/D; facing at radius
/// rho: p = f_pp rho^2 + c_ax, q = -f_wp rho.  In bores e is the material left standing,
/// which makes the radius smaller: with the bar's y_w, y_p per Fp and Ff at its tip f and
/// y_t per Fc,
///
///     p = f_ww + y_w + c_rr,  q = +-(f_wp D/2 - y_p f),  s = -c_rt,
///     r = -(f_ww,t + y_t)^2/D                                                        (3)
///
/// The shoulder between two bores is faced by a bar that feeds outwards.  Its feed force
/// draws the part to the tool's side, which turns the section of the face away from the
/// tool there, and pushes the bar off the wall, whose tip, at f beside its axis, then comes
/// forward by y_p; the passive force pushes the tip back by y_z, and shortens the bar, y_a:
///
///     p = f_pp rho^2 + c_ax + y_z + y_a,  q = f_wp rho - y_p                         (4)
///
/// In the first order no force along vc moves the tip along the bar.
/// Source: derived here from (1) with the feed turned round, and by reciprocity from the
/// y_p of (3); inner_shoulder_test has each alone.
///
/// Each coefficient depends on the finishing depth, through the body during the pass.
struct Law {
  Polynomial p, q, s, r;
};

/// A law at one finishing depth.
template <class T>
struct Coefficients {
  T p, q, s, r;
};
template <class T>
Coefficients<T> at(const Law& law, const T& a) {
  return {law.p(a), law.q(a), law.s(a), law.r(a)};
}

/// Eq. (1).
template <class T>
Signed<T> law_mm(const Coefficients<Signed<T>>& c, const cutting::Forces<T>& forces) {
  const Signed<T> Fc = linear(forces.Fc_N);
  return forces.Fp_N * c.p + linear(forces.Ff_N) * c.q + Fc * c.s + sqr(Fc) * c.r;
}

/// Depth-of-cut feedback: a surface that yields by e is cut less deep by e,
///
///     e = law(forces at depth ap + e_before - e),                                    (2)
///         e_before the error that the pass before has left
///
/// Where the part is pulled into the tool without bound the result is a hundred depths.
/// Source: derived here; the loop gain is d law/d depth.
double yielding_mm(const Coefficients<double>& law, const cutting::Cut& cut, double ap,
                   double f, double e_before);

/// d law/d depth.
double loop_gain(const Coefficients<double>& law, const cutting::Cut& cut, double depth,
                 double f);

/// (2) with its gradient, by the implicit function theorem: e' = law'/(1 + gain).
template <int N>
Dual<double, N> yielding_mm(const Law& law, const cutting::Cut& cut,
                            const Dual<double, N>& a, const Dual<double, N>& ap,
                            const Dual<double, N>& f, const Dual<double, N>& e_before) {
  const auto c = at(law, a);
  const Coefficients<double> point{c.p.v, c.q.v, c.s.v, c.r.v};
  const auto full = ap + e_before;
  if (!(full.v > 0)) return full;
  const double e = yielding_mm(point, cut, ap.v, f.v, e_before.v);
  const Dual<double, N> depth = full - e;
  const auto direct = law_mm<Dual<double, N>>(c, cutting::forces_N(cut, depth, f));
  Dual<double, N> r = direct * (1 / (1 + loop_gain(point, cut, depth.v, f.v)));
  r.v = e;
  return r;
}

/// Depth and feed as the variables of their own box.
struct DepthAndFeed {
  std::array<Interval, 2> y;
  LogDual<2>::Half half;
  LogDual<2> ap, f;
  DepthAndFeed(const Interval& depth, const Interval& feed)
      : y{log(depth), log(feed)},
        half{width(y[0]) / 2, width(y[1]) / 2},
        ap(LogDual<2>::variable(y[0], 0, half)),
        f(LogDual<2>::variable(y[1], 1, half)) {}
};

/// Enclosures of (2) where law, f and the full depth ap + e_before are intervals: the
/// error, the depth full - e that is really cut, and the loop gain there.
struct Yielding {
  Interval e = Interval::whole();
  Interval depth = Interval::whole();
  Interval gain = Interval::whole();
};
Yielding yielding_range(const Coefficients<Interval>& law, const cutting::Cut& cut,
                        const Interval& full, const Interval& f);

/// An error over a box, and what it follows from: the law, the error that the pass before
/// has left, and the enclosures of (2).
template <int N>
struct Yielded {
  Dual<Interval, N> e;
  Coefficients<Dual<Interval, N>> law{};
  Dual<Interval, N> e_before;
  Yielding range;
};

/// (2) enclosed over a box with its gradient: e' = m law' + (1 - m) full', m = 1/(1 +
/// gain) and law' without the depth.
template <int N>
Yielded<N> yielded(const Law& law, const cutting::Cut& cut, const LogDual<N>& a,
                   const LogDual<N>& ap, const LogDual<N>& f,
                   const Dual<Interval, N>& e_before) {
  const auto c = at(law, linear(a));
  const Dual<Interval, N> full = linear(ap) + e_before;
  const Yielding y = yielding_range({c.p.v, c.q.v, c.s.v, c.r.v}, cut, full.v, exp(f.ln));
  Yielded<N> r{{}, c, e_before, y};
  r.e.v = y.e;
  r.e.d.fill(Interval::whole());
  if (!(y.gain.lo > -1)) return r;
  const LogDual<N> depth = positive(Dual<Interval, N>(y.depth, {}));
  const auto direct = law_mm<LogDual<N>>(c, cutting::forces_N(cut, depth, f));
  const Interval m = Interval(1) / (Interval(1) + y.gain);
  for (std::size_t i = 0; i < N; ++i)
    r.e.d[i] = direct.d[i] * m + full.d[i] * (Interval(1) - m);
  return r;
}
template <int N>
Dual<Interval, N> yielding_mm(const Law& law, const cutting::Cut& cut,
                              const LogDual<N>& a, const LogDual<N>& ap,
                              const LogDual<N>& f, const Dual<Interval, N>& e_before) {
  return yielded(law, cut, a, ap, f, e_before).e;
}

inline double yielding_mm(const Law& law, const cutting::Cut& cut, double a, double ap,
                          double f, double e_before) {
  return yielding_mm(at(law, a), cut, ap, f, e_before);
}

}  // namespace turnwright::planning
