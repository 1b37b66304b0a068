#pragma once
#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "turnwright/cutting/cut.hpp"
#include "turnwright/cutting/spindle.hpp"
#include "turnwright/planning/plan_request.hpp"

/// The operations that make one feature - roughing passes and finishing passes of an
/// element, or the passes over a face - as functions of their conditions, over any
/// scalar. Passes and tools are fixed here; speed and feed of each operation, and how the
/// stock is divided between them, are open.
namespace turnwright::planning {

/// c0 + c1 a, a the finishing depth [mm].
struct Affine {
  double c0 = 0, c1 = 0;
  template <class T>
  T operator()(const T& a) const {
    if (c1 == 0) return T(c0);
    if (c0 == 0) return c1 * a;
    return c1 > 0 ? T(T(c0) + c1 * a) : T(T(c0) - T(-c1 * a));
  }
};

/// Polynomial in u = (a - centre)/half, ascending; a constant has one coefficient.
struct Polynomial {
  double centre = 0, half = 1;
  std::vector<double> c{0};
  template <class T>
  T operator()(const T& a) const {
    if (c.size() == 1) return T(c[0]);
    const T u = (a - centre) * (1 / half);
    T sum = T(c.back());
    for (std::size_t k = c.size() - 1; k-- > 0;) sum = sum * u + c[k];
    return sum;
  }
};

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
/// Each coefficient depends on the finishing depth, through the body during the pass.
struct Law {
  Polynomial p, q, s, r;
};

/// One position on the surface (z, or rho of a face) with its law in every pass.
struct Station {
  double at_mm = 0;
  std::vector<Law> passes;
};

/// Linear constraint of a tolerance at some positions: sum of weight_k e(station_k) <=
/// limit.
struct Functional {
  std::vector<std::pair<std::size_t, double>> terms;
  double limit = 0;
  std::size_t tolerance = 0;  ///< index into the drawing's tolerances
};

/// The limits against which the conditions of an operation are checked; limit_table.hpp
/// has a row for each.
enum class Check {
  depth_min,
  depth_max,
  feed_min,
  feed_max,
  vc_min,
  vc_max,
  tolerance,
  Ra,
  Rz,
  power,
  torque,
  feed_force,
  grip,
  spindle_max,
  spindle_min,
  force,
  life_min,
  life_max,
  chatter,
  chip_min,
  chip_max,
  speed_window,
  stable_depth,  ///< of milled places, as are the next
  part_compliance,
  milled_depth_max,
  chip_thickness_max,
  chip_thickness_min,
  milled_vc_max,
  milled_n_max,
  milled_feed_max
};

/// Whether a check's value may have either sign, or vanish.
inline bool either_sign(Check c) { return c == Check::tolerance || c == Check::chatter; }

/// One pass: the material left on the radius after it, and its path.
struct PassModel {
  Affine left_mm;  ///< radius offset of the surface it leaves
  double path_mm = 0;
};

/// One operation of the chain.
struct OperationModel {
  const catalogue::Tool* tool = nullptr;
  cutting::Cut cut;
  cutting::SpeedRange range;
  cutting::Grip grip;
  double n_cap_rpm = 0;        ///< machine, chuck and centrifugal loss
  bool n_cap_of_grip = false;  ///< the centrifugal loss is the lowest of them
  double n_min_rpm = 0;
  double feed_force_max_N = 0;
  /// Tool life of least cost; it allows for feed in the air, which costs time but does
  /// not wear the edge.
  double economic_life_min = 0;
  double Ra_um = 0, Rz_um = 0;  ///< 0: not required
  /// 1/limit of the chatter stiffness at the positions where it is imposed, over the
  /// finishing depth (Feature::limit_chatter).
  std::vector<Polynomial> chatter_mm_N;
  std::vector<double> chatter_at_mm;  ///< these positions
  double chatter_inwards = 1;         ///< limit where K > 0 over that where K < 0
  catalogue::Range vc, f;  ///< open ranges: the tool's, or as the request fixes them
  catalogue::Range vc_window, f_window, ap;  ///< allowed by the tool
  std::vector<catalogue::ChipEdge> chip;     ///< and these of its chip breaker
  catalogue::Range T_min;
  Affine depth_mm;
  std::vector<PassModel> passes;
  double fed = 1;        ///< feed of the program's passes over that in the cut, >= 1
  double rapid_min = 0;  ///< approach and return of all passes
  double D_small_mm = 0, D_large_mm = 0;  ///< of the finished feature
  bool tapered = false, reaches_axis = false, face = false, finishing = false;
  bool inner = false;     ///< a bore: material left makes it narrower
  double least_D_mm = 0;  ///< of a bore: the hole it starts from

  /// Sum over all passes.
  Affine left_sum_mm() const {
    Affine sum;
    for (const auto& p : passes) {
      sum.c0 += p.left_mm.c0;
      sum.c1 += p.left_mm.c1;
    }
    return sum;
  }
  /// The pass at the largest and at the smallest diameter.
  const PassModel& widest() const { return inner ? passes.back() : passes.front(); }
  const PassModel& narrowest() const { return inner ? passes.front() : passes.back(); }
};

struct Weights {
  double minute = 0, edge = 0;  ///< of the objective
};

struct Chain {
  std::vector<OperationModel> operations;  ///< one or two
  catalogue::Range a;                      ///< finishing depth; lower == upper: fixed
  std::vector<Station> stations;
  std::vector<Functional> functionals;
  Weights weights;
};

/// Conditions of a chain: per operation speed and feed, and the finishing depth.
template <class T>
struct Choice {
  std::array<T, 2> v{}, f{};
  T a{};
};

/// The sweep of one pass.
template <class T>
cutting::Sweep<T> sweep(const OperationModel& o, const PassModel& p, const T& a) {
  const T left = p.left_mm(a);
  const auto D = [&](double finished) -> T {
    if (o.face) return T(finished);
    if (o.inner) return difference(T(finished), T(left * 2.0), o.least_D_mm);
    return left * 2.0 + finished;
  };
  return {p.path_mm, D(o.D_small_mm), D(o.D_large_mm), o.tapered, o.reaches_axis};
}

/// Force on the tool needed from the jaws [N], the largest of the passes.
template <class T>
T grip_needed(const OperationModel& o, const cutting::Forces<T>& F, const T& a) {
  const T D = sweep(o, o.widest(), a).D_large_mm;
  return cutting::grip_needed_N(o.grip, F.Fc_N, F.Ff_N,
                                o.face || o.inner ? D : T(D + 2.0 * o.depth_mm(a)));
}

/// The spindle limit [1/min] of an operation: fixed, and where the grip ends.
template <class T>
T spindle_cap(const OperationModel& o, const cutting::Forces<T>& F, const T& a) {
  using std::min;
  if (!(o.grip.force_N > 0) || !o.tapered) return T(o.n_cap_rpm);
  return min(T(o.n_cap_rpm), cutting::grip_rpm(o.grip, grip_needed(o, F, a)));
}

/// Hands every check that does not depend on the speed to sink(check, value, limit).
template <class T, class Sink>
void depth_checks(const OperationModel& o, const T& f, const T& a,
                  const cutting::Forces<T>& F, const Sink& sink) {
  if (o.depth_mm.c1 != 0 || o.depth_mm.c0 != 0) {
    const T ap = o.depth_mm(a);
    sink(Check::depth_min, T(o.ap.lower), ap);
    sink(Check::depth_max, ap, T(o.ap.upper));
  }
  sink(Check::feed_min, T(o.f_window.lower), f);
  sink(Check::feed_max, f, T(o.f_window.upper));
  for (const auto& e : o.chip) {
    using std::pow;
    const T edge = e.f1_mm_rev * pow(o.depth_mm(a), e.exponent);
    if (e.upper)
      sink(Check::chip_max, f, edge);
    else
      sink(Check::chip_min, edge, f);
  }
  sink(Check::force, F.Fc_N, T(o.tool->Fc_max_N));
  sink(Check::feed_force, F.Ff_N, T(o.feed_force_max_N));
  if (o.grip.force_N > 0 && o.tapered)
    sink(Check::grip, grip_needed(o, F, a), T(0.999 * o.grip.force_N));
  const auto widest = sweep(o, o.widest(), a);
  for (const auto& l : o.range.lines)
    if (cutting::constant_torque(l))
      sink(l.torque ? Check::torque : Check::power,
           cutting::power_share(l, F.Fc_N, widest, T(1.0), T(o.n_cap_rpm)), T(1.0));
  if (o.Ra_um > 0) sink(Check::Ra, cutting::Ra_um(o.cut, f), T(o.Ra_um));
  if (o.Rz_um > 0) sink(Check::Rz, cutting::Rz_um(o.cut, f), T(o.Rz_um));
}

/// What is held against the limit of the chatter stiffness: K, or -K in the proportion of
/// both limits where it is negative.
inline double chatter_N_mm(const OperationModel& o, double f, double a,
                           const cutting::Forces<double>& F) {
  const double K = cutting::chatter_stiffness_N_mm(o.cut, F, o.depth_mm(a), f);
  return std::max(K, -o.chatter_inwards * K);
}

/// And chatter, in terms of either sign: K/limit at each place.
template <class T, class Sink>
void chatter_checks(const OperationModel& o, std::size_t operation, const T& f,
                    const T& a, const cutting::Forces<T>& F, const Sink& sink) {
  if (o.chatter_mm_N.empty()) return;
  const Signed<T> K = cutting::chatter_stiffness_N_mm(o.cut, F, o.depth_mm(a), f);
  const bool pushed = o.cut.kp && o.cut.corner.cotangent < 0;  // K < 0 may be
  for (const auto& c : o.chatter_mm_N) {
    const Signed<T> share = K * c(linear(a));
    sink(operation, Check::chatter, false, share, Signed<T>(1.0));
    if (pushed)
      sink(operation, Check::chatter, false, Signed<T>(share * -o.chatter_inwards),
           Signed<T>(1.0));
  }
}

/// And every check of the speed.
template <class T, class Sink>
void speed_checks(const OperationModel& o, const T& v, const T& f, const T& a,
                  const cutting::Forces<T>& F, const T& n_cap, const Sink& sink) {
  const auto widest = sweep(o, o.widest(), a), narrowest = sweep(o, o.narrowest(), a);
  for (const auto& l : o.range.lines)
    if (!cutting::constant_torque(l))
      sink(l.torque ? Check::torque : Check::power,
           cutting::power_share(l, F.Fc_N, l.s >= 0 ? widest : narrowest, v, n_cap),
           T(1.0));
  sink(Check::vc_min, T(o.vc_window.lower), v);
  sink(Check::vc_max, v, T(o.vc_window.upper));
  const T life = cutting::tool_life_min(o.cut, v, f, o.depth_mm(a));
  sink(Check::life_min, T(o.T_min.lower), life);
  sink(Check::life_max, life, T(o.T_min.upper));
  sink(Check::spindle_min, T(o.n_min_rpm),
       T(v / widest.D_large_mm * (1000 / units::kPi)));
  if (o.tapered) return;  // the clamp keeps n <= n_cap
  const T n = v / narrowest.D_small_mm * (1000 / units::kPi);
  sink(Check::spindle_max, n, n_cap);
  if (o.grip.force_N > 0)
    sink(Check::grip, grip_needed(o, F, a) + cutting::grip_loss_N(o.grip, n),
         T(o.grip.force_N));
}

/// The speeds at which each check of speed_checks holds with equality, in its order, to
/// sink(upper limit?, speed).
template <class T, class Sink>
void speed_limits(const OperationModel& o, const T& f, const T& a,
                  const cutting::Forces<T>& F, const T& n_cap, const Sink& sink) {
  using std::min;
  const auto widest = sweep(o, o.widest(), a), narrowest = sweep(o, o.narrowest(), a);
  const T ap = o.depth_mm(a);
  for (const auto& l : o.range.lines)
    if (!cutting::constant_torque(l))
      sink(l.s < 1, cutting::speed_at_power_m_min(l, F.Fc_N,
                                                  l.s >= 0 ? widest : narrowest, n_cap));
  sink(false, T(o.vc_window.lower));
  sink(true, T(o.vc_window.upper));
  sink(true, cutting::speed_for_life_m_min(o.cut, o.T_min.lower, f, ap));
  sink(false, cutting::speed_for_life_m_min(o.cut, o.T_min.upper, f, ap));
  sink(false, T(widest.D_large_mm * (o.n_min_rpm * units::kPi / 1000)));
  if (o.tapered) return;
  const auto at_rpm = [&](const T& n) {
    return T(narrowest.D_small_mm * n * (units::kPi / 1000));
  };
  sink(true, at_rpm(n_cap));
  if (o.grip.force_N > 0)
    sink(true, at_rpm(cutting::grip_rpm(o.grip, grip_needed(o, F, a))));
}

/// Weights of an operation's speed limits, in their order: the multipliers of its checks.
using SpeedWeights = std::vector<double>;

/// The speeds that satisfy speed_checks.
template <class T>
struct Window {
  T lower{}, upper{};
};
template <class T>
Window<T> speed_window(const OperationModel& o, const T& f, const T& a,
                       const cutting::Forces<T>& F, const T& n_cap) {
  Window<T> w{T(o.vc.lower), T(o.vc.upper)};
  speed_limits(o, f, a, F, n_cap, [&](bool upper, const T& v) {
    using std::max;
    using std::min;
    if (upper)
      w.upper = min(w.upper, v);
    else
      w.lower = max(w.lower, v);
  });
  return w;
}

/// A window that holds speed_window and has no corners: each end the mean of its limits
/// in the proportions of the weights, v1^w1 v2^w2 ... with w1 + w2 + ... = 1, which lies
/// between them.
template <class T>
Window<T> smooth_window(const OperationModel& o, const T& f, const T& a,
                        const cutting::Forces<T>& F, const T& n_cap,
                        const SpeedWeights& weights, Window<T> w) {
  std::array<double, 2> sum{};
  std::size_t k = 0;
  speed_limits(o, f, a, F, n_cap,
               [&](bool upper, const T&) { sum[upper] += weights[k++]; });
  std::array<T, 2> mean{T(1.0), T(1.0)};
  k = 0;
  speed_limits(o, f, a, F, n_cap, [&](bool upper, const T& v) {
    using std::pow;
    const double weight = weights[k++];
    if (weight > 0) mean[upper] = mean[upper] * pow(v, weight / sum[upper]);
  });
  if (sum[0] > 0) w.lower = mean[0];
  if (sum[1] > 0) w.upper = mean[1];
  return w;
}

/// Minutes and edges of all passes of an operation at a speed and the life it gives.
template <class T>
cutting::Duty<T> duty(const OperationModel& o, const T& v, const T& f, const T& a,
                      const T& n_cap, const T& life) {
  cutting::Duty<T> sum;
  if (!o.tapered && !o.inner) {  // cylinders add up to one
    auto whole = sweep(o, PassModel{o.left_sum_mm(), o.passes[0].path_mm}, a);
    whole.D_large_mm =
        whole.D_large_mm + static_cast<double>(o.passes.size() - 1) * o.D_large_mm;
    return cutting::duty(whole, v, f, life, n_cap, o.cut.taylor.n);
  }
  for (std::size_t k = 0; k < o.passes.size(); ++k) {
    const auto d =
        cutting::duty(sweep(o, o.passes[k], a), v, f, life, n_cap, o.cut.taylor.n);
    sum = k == 0 ? d : cutting::Duty<T>{sum.time_min + d.time_min, sum.edges + d.edges};
  }
  return sum;
}

/// Minutes of an operation in the air: feed beside the surface, approach and return.
template <class T>
T air_min(const OperationModel& o, const cutting::Duty<T>& d) {
  return d.time_min * (o.fed - 1) + o.rapid_min;
}

/// Contribution of an operation to the objective: minutes in the cut, in the air, and
/// changing edges.
template <class T>
T objective(const OperationModel& o, const Weights& w, const cutting::Duty<T>& d) {
  return w.minute * (d.time_min * o.fed + o.rapid_min) +
         (w.minute * o.tool->change_min + w.edge * o.tool->edge_cost) * d.edges;
}

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

/// Enclosures of (2) where law, f and the full depth ap + e_before are intervals: the
/// error, the depth full - e that is really cut, and the loop gain there.
struct Yielding {
  Interval e = Interval::whole();
  Interval depth = Interval::whole();
  Interval gain = Interval::whole();
};
Yielding yielding_range(const Coefficients<Interval>& law, const cutting::Cut& cut,
                        const Interval& full, const Interval& f);

/// (2) enclosed over a box with its gradient: e' = m law' + (1 - m) full', m = 1/(1 +
/// gain) and law' without the depth.
template <int N>
Dual<Interval, N> yielding_mm(const Law& law, const cutting::Cut& cut,
                              const LogDual<N>& a, const LogDual<N>& ap,
                              const LogDual<N>& f, const Dual<Interval, N>& e_before) {
  const auto c = at(law, linear(a));
  const Dual<Interval, N> full = linear(ap) + e_before;
  const Yielding y = yielding_range({c.p.v, c.q.v, c.s.v, c.r.v}, cut, full.v, exp(f.ln));
  Dual<Interval, N> r;
  r.v = y.e;
  r.d.fill(Interval::whole());
  if (!(y.gain.lo > -1)) return r;
  const LogDual<N> depth = positive(Dual<Interval, N>(y.depth, {}));
  const auto direct = law_mm<LogDual<N>>(c, cutting::forces_N(cut, depth, f));
  const Interval m = Interval(1) / (Interval(1) + y.gain);
  for (std::size_t i = 0; i < N; ++i)
    r.d[i] = direct.d[i] * m + full.d[i] * (Interval(1) - m);
  return r;
}

/// The last pass of a chain at a station: its law, full depth and feed.
struct LastPass {
  Coefficients<double> law{};
  const cutting::Cut* cut = nullptr;
  double depth_mm = 0, f_mm_rev = 0;
};
LastPass last_pass(const Chain& chain, const Station& station,
                   const Choice<double>& choice);

/// Correction of the path of a last pass towards the material that leaves no error: the
/// law at the full depth, which is then really cut, s = law(full).  It is not -e, because
/// a deeper cut yields more.  On a face the depth has no influence.
double correction_mm(const LastPass& pass);
/// Error that remains with the path moved by s towards the material, by (2) with a depth
/// larger by s: y = law(full + s - y), e = y - s.
double corrected_error_mm(const LastPass& pass, double s_mm);

inline double yielding_mm(const Law& law, const cutting::Cut& cut, double a, double ap,
                          double f, double e_before) {
  return yielding_mm(at(law, a), cut, ap, f, e_before);
}

/// Error of the finished surface at a station after all passes.  Faces have no feedback:
/// yielding along the axis changes the length, not the depth.
template <class T>
Signed<T> error_mm(const Chain& chain, const Station& station, const Choice<T>& c,
                   const std::array<cutting::Forces<T>, 2>& F) {
  Signed<T> e(0.0);
  std::size_t k = 0;
  for (std::size_t i = 0; i < chain.operations.size(); ++i) {
    const auto& o = chain.operations[i];
    const T ap = o.depth_mm(c.a);
    for (std::size_t p = 0; p < o.passes.size(); ++p, ++k)
      e = o.face ? law_mm<T>(at(station.passes[k], linear(c.a)), F[i])
                 : yielding_mm(station.passes[k], o.cut, c.a, ap, c.f[i], e);
  }
  return e;
}

/// Value and limit of every functional.
template <class T, class Sink>
void tolerance_checks(const Chain& chain, const Choice<T>& c,
                      const std::array<cutting::Forces<T>, 2>& F, const Sink& sink) {
  if (chain.functionals.empty()) return;
  std::vector<Signed<T>> e;
  e.reserve(chain.stations.size());
  for (const auto& s : chain.stations) e.push_back(error_mm(chain, s, c, F));
  for (std::size_t i = 0; i < chain.functionals.size(); ++i) {
    const auto& g = chain.functionals[i];
    Signed<T> sum = e[g.terms[0].first] * g.terms[0].second;
    for (std::size_t k = 1; k < g.terms.size(); ++k)
      sum = sum + e[g.terms[k].first] * g.terms[k].second;
    sink(i, Check::tolerance, false, sum, Signed<T>(g.limit));
  }
}

/// Forces of each operation at full depth.
template <class T>
std::array<cutting::Forces<T>, 2> forces(const Chain& chain, const Choice<T>& c) {
  std::array<cutting::Forces<T>, 2> F{};
  for (std::size_t i = 0; i < chain.operations.size(); ++i)
    F[i] = cutting::forces_N(chain.operations[i].cut, chain.operations[i].depth_mm(c.a),
                             c.f[i]);
  return F;
}

template <class T, class Sink>
auto tagged(const Sink& sink, std::size_t operation, bool speed) {
  return [&sink, operation, speed](Check check, const T& value, const T& limit) {
    sink(operation, check, speed, value, limit);
  };
}

/// Objective of the chain, at chosen speeds; every check goes to
/// sink(operation, check, depends on the speed, value, limit), of a tolerance the
/// functional's number in place of the operation's.
template <class T, class Sink>
T evaluate(const Chain& chain, const Choice<T>& c, const Sink& sink) {
  const auto F = forces(chain, c);
  T sum{};
  for (std::size_t i = 0; i < chain.operations.size(); ++i) {
    const auto& o = chain.operations[i];
    const T n_cap = spindle_cap(o, F[i], c.a);
    depth_checks(o, c.f[i], c.a, F[i], tagged<T>(sink, i, false));
    chatter_checks(o, i, c.f[i], c.a, F[i], sink);
    speed_checks(o, c.v[i], c.f[i], c.a, F[i], n_cap, tagged<T>(sink, i, true));
    const T life = cutting::tool_life_min(o.cut, c.v[i], c.f[i], o.depth_mm(c.a));
    const T cost = objective(o, chain.weights, duty(o, c.v[i], c.f[i], c.a, n_cap, life));
    sum = i == 0 ? cost : sum + cost;
  }
  tolerance_checks(chain, c, F, sink);
  return sum;
}

/// Speed of least cost in a window, and the life it gives.
template <class T>
struct BestSpeed {
  T v{}, life{};
};
template <class T>
BestSpeed<T> best_speed(const OperationModel& o, const T& f, const T& a,
                        const Window<T>& w) {
  using std::max;
  using std::min;
  using std::pow;
  const T economic =
      cutting::speed_for_life_m_min(o.cut, o.economic_life_min, f, o.depth_mm(a));
  const T ratio = min(max(T(1.0), T(w.lower / economic)), T(w.upper / economic));
  return {economic * ratio, o.economic_life_min * pow(ratio, -1 / o.cut.taylor.n)};
}

/// Objective with the best speeds, and a function nowhere above it without the corners
/// that speed limits make where they cross.
template <class T>
struct Reduced {
  T objective{}, smooth{};
};

/// As `evaluate`, with each speed at its best for the feed and depth: the economic one,
/// held in its window.  c.v is set.  The cost falls and then rises with the speed (both
/// terms of the duty are powers of it while unclamped, and stand still where clamped), so
/// the nearest speed of the window is the best one.  Its life follows from how far it is
/// from the economic one, T_e (v/v_e)^(-1/n): over a box that says more than Taylor's law
/// with a speed, feed and depth that each vary.  A wider window cannot cost more, which
/// gives `smooth` from the weights of each operation's speed limits (none: the
/// objective).
template <class T, class Sink>
Reduced<T> evaluate_at_best_speed(const Chain& chain, Choice<T>& c,
                                  const std::array<SpeedWeights, 2>& weights,
                                  const Sink& sink) {
  const auto F = forces(chain, c);
  Reduced<T> sum;
  for (std::size_t i = 0; i < chain.operations.size(); ++i) {
    const auto& o = chain.operations[i];
    const T n_cap = spindle_cap(o, F[i], c.a);
    depth_checks(o, c.f[i], c.a, F[i], tagged<T>(sink, i, false));
    chatter_checks(o, i, c.f[i], c.a, F[i], sink);
    const auto w = speed_window(o, c.f[i], c.a, F[i], n_cap);
    sink(i, Check::speed_window, true, w.lower, w.upper);
    const auto cost = [&](const BestSpeed<T>& best) {
      return objective(o, chain.weights, duty(o, best.v, c.f[i], c.a, n_cap, best.life));
    };
    const auto best = best_speed(o, c.f[i], c.a, w);
    c.v[i] = best.v;
    const Reduced<T> own{cost(best),
                         weights[i].empty()
                             ? cost(best)
                             : cost(best_speed(o, c.f[i], c.a,
                                               smooth_window(o, c.f[i], c.a, F[i], n_cap,
                                                             weights[i], w)))};
    sum =
        i == 0 ? own : Reduced<T>{sum.objective + own.objective, sum.smooth + own.smooth};
  }
  tolerance_checks(chain, c, F, sink);
  return sum;
}

}  // namespace turnwright::planning
