#pragma once
#include <cmath>
#include <vector>

#include "turnwright/base/log_dual.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/catalogue/machine.hpp"

/// Spindle speed and power, gripping force of the chuck, and the time of a pass at constant
/// surface speed.
namespace turnwright::cutting {

/// Power at the cut [kW] that one segment of a curve allows: P(n) = c n^s.
struct PowerLine {
  double c = 0, s = 0;
  bool torque = false;  ///< from the torque curve
};

/// A range of spindle speeds over which the available power is the minimum of some lines.
struct SpeedRange {
  double n_min_rpm = 0, n_max_rpm = 0;
  std::vector<PowerLine> lines;
};

/// Power and torque curves times the efficiency, interpolated log-log between their
/// points, with constant torque below the first point.  A log-concave curve is the
/// minimum of the lines through its segments; a curve with dips is cut into ranges in
/// which that holds.  A dip of at most 3 %, as rounding and digitising make, cuts no range:
/// the line over it is lowered onto it, so that the lines lie nowhere above the curve.
std::vector<SpeedRange> speed_ranges(const catalogue::Lathe& machine);
std::vector<SpeedRange> speed_ranges(const catalogue::DrivenTools& spindle);

/// A straight path of the tool, along which the diameter changes linearly or not at all.
template <class T>
struct Sweep {
  T path_mm{};
  T D_small_mm{}, D_large_mm{};
  bool tapered = false;       ///< D_small < D_large
  bool reaches_axis = false;  ///< D_small = 0, the face of a solid part
};

/// Spindle speed [1/min] of a sweep at which a power line is most restrictive: the lowest
/// speed, at D_large, for s >= 0; the highest, min(n_cap, 1000 v/(pi D_small)), for s <
/// 0.
template <class T>
T decisive_rpm(const PowerLine& l, const Sweep<T>& s, const T& vc_m_min,
               const T& n_cap_rpm) {
  using std::min;
  const double per_D = 1000 / units::kPi;
  if (l.s >= 0 || !s.tapered) return vc_m_min / s.D_large_mm * per_D;
  if (s.reaches_axis) return n_cap_rpm;
  return min(n_cap_rpm, T(vc_m_min / s.D_small_mm * per_D));
}

/// Whether the line is one of constant torque, P ~ n, on which the speed has no effect.
inline bool constant_torque(const PowerLine& l) { return std::abs(l.s - 1) < 1e-9; }

/// Cutting speed [m/min] at which the cut uses exactly the power of a line that is not of
/// constant torque:
///
///     Fc v/60000 = c n^s, with the most restrictive n (1)
///
/// It is an upper limit of v for s < 1 and a lower limit for s > 1.
template <class T>
T speed_at_power_m_min(const PowerLine& l, const T& Fc_N, const Sweep<T>& s,
                       const T& n_cap_rpm) {
  using std::max;
  using std::pow;
  const double per_D = 1000 / units::kPi;
  const T k = (60000 * l.c) / Fc_N;
  const auto at = [&](const T& D) -> T {
    return pow(k * pow(per_D / D, l.s), 1 / (1 - l.s));
  };
  if (l.s >= 0 || !s.tapered) return at(s.D_large_mm);
  const T at_cap = k * pow(n_cap_rpm, l.s);
  return s.reaches_axis ? at_cap : max(at_cap, at(s.D_small_mm));
}

/// Required power divided by the power that a line allows; at most 1 where it is enough.
template <class T>
T power_share(const PowerLine& l, const T& Fc_N, const Sweep<T>& s, const T& vc_m_min,
              const T& n_cap_rpm) {
  using std::pow;
  const T n = decisive_rpm(l, s, vc_m_min, n_cap_rpm);
  if (constant_torque(l)) return Fc_N * s.D_large_mm * (units::kPi / 6e7 / l.c);
  return units::power_kW(Fc_N, vc_m_min) / (l.c * pow(n, l.s));
}

/// Grip of a three-jaw chuck on the outside, after VDI 3106:
///
///     Fsp(n) = Fsp0 - sum(m r) (pi n/30)^2 >= Sz F/mu,  Sz = 1.5                     (2)
///     F = hypot(Fc d_cut/d_grip, Ff): load on the friction, around and along the axis
///     centrifugal loss <= 0.67 Fsp0
///
/// The tilting moment of the passive force is not modelled.
struct Grip {
  double force_N = 0;  ///< Fsp0; 0 = nothing is gripped (between centres)
  double mr_kg_m = 0;
  double friction = 0;
  double d_grip_mm = 0;
};
inline constexpr double kGripSafety = 1.5;
inline constexpr double kGripLoss = 0.67;

/// Gripping force [N] needed at rest, Sz F/mu.
template <class T>
T grip_needed_N(const Grip& g, const T& Fc_N, const T& Ff_N, const T& d_cut_mm) {
  using std::sqrt;
  return (kGripSafety / g.friction) *
         sqrt(sqr(Fc_N * d_cut_mm * (1 / g.d_grip_mm)) + sqr(Ff_N));
}

/// Gripping force [N] lost at a spindle speed.
template <class T>
T grip_loss_N(const Grip& g, const T& n_rpm) {
  return sqr(n_rpm * (units::kPi / 30)) * g.mr_kg_m;
}

/// Spindle speed [1/min] at which (2) holds with equality.  The required force is limited
/// to 0.999 of Fsp0; where it is larger the check at rest fails anyway.
template <class T>
T grip_rpm(const Grip& g, const T& needed_N) {
  using std::sqrt;
  const T spare = difference(T(g.force_N), needed_N, 0.001 * g.force_N);
  return sqrt(spare * (1 / g.mr_kg_m)) * (30 / units::kPi);
}

/// Minutes in the cut, and edges worn out, of one pass.
template <class T>
struct Duty {
  T time_min{}, edges{};
};

/// Duty of a pass at constant surface speed v, with the spindle limited to n_cap where
/// the diameter is small.  Along the path dt = ds/(f n), n = min(n_cap, 1000 v/(pi D)),
/// and the edge wears at the rate 1/T of the actual speed v_eff = pi D n/1000, T ~
/// v^(-1/n_T):
///
///     time  = (l/(f dD)) [ (D_s - D_1)/n_cap + pi (D_2^2 - D_s^2)/(2000 v) ]         (3)
///     edges = (l/(f dD T(v))) [ (D_s (D_s/D_c)^q - D_1 (D_1/D_c)^q)/((q + 1) n_cap)
///                               + pi (D_2^2 - D_s^2)/(2000 v) ],  q = 1/n_T          (4)
///     D_c = 1000 v/(pi n_cap),  D_s = D_c held in [D_1, D_2]
///
/// For a cylinder time = pi D l/(1000 v f) and edges = time/T; its v must not require
/// more than n_cap.  Source: derived here; spindle_test integrates numerically.
template <class T>
Duty<T> duty(const Sweep<T>& s, const T& vc_m_min, const T& f_mm_rev, const T& life_min,
             const T& n_cap_rpm, double taylor_n) {
  using std::max;
  using std::min;
  using std::pow;
  if (!s.tapered) {
    const T time = s.D_large_mm * s.path_mm * (units::kPi / 1000) / (vc_m_min * f_mm_rev);
    return {time, time / life_min};
  }
  const T &D1 = s.D_small_mm, &D2 = s.D_large_mm;
  const double q = 1 / taylor_n;
  const T Dc = vc_m_min / n_cap_rpm * (1000 / units::kPi);
  const T Ds = min(max(Dc, D1), D2);
  const T unclamped = (D2 - Ds) * (D2 + Ds) / vc_m_min * (units::kPi / 2000);
  const T worn =
      (Ds * pow(Ds / Dc, q) - D1 * pow(D1 / Dc, q)) / n_cap_rpm * (1 / (q + 1));
  const T scale = s.path_mm / (f_mm_rev * (D2 - D1));
  return {scale * ((Ds - D1) / n_cap_rpm + unclamped),  // Eq. (3)
          scale * (worn + unclamped) / life_min};       // Eq. (4)
}

namespace detail {
// Minutes and wear of a sweep for T(v) = 1, per feed and per change of diameter, split at
// D_s into the part at the limited speed (clamped) and the rest.
struct Split {
  double clamped_time = 0, clamped_wear = 0, unclamped = 0;
};
inline Split split(double D1, double D2, double v, double n_cap, double q) {
  const double Dc = v / n_cap * (1000 / units::kPi);
  const double Ds = std::min(std::max(Dc, D1), D2);
  return {(Ds - D1) / n_cap,
          (Ds * std::pow(Ds / Dc, q) - D1 * std::pow(D1 / Dc, q)) / n_cap / (q + 1),
          (D2 - Ds) * (D2 + Ds) / v * (units::kPi / 2000)};
}
template <int N>
LogDual<N> between(double low, double high, double centre,
                   const typename LogDual<N>::Gradient& d,
                   const typename LogDual<N>::Half* half) {
  LogDual<N> r;
  r.ln = {std::log(low), std::log(high)};
  r.centre = std::log(centre);
  r.d = d;
  r.half = half;
  return turnwright::detail::centred(r);
}
}  // namespace detail

/// Enclosure of (3) and (4).  Time falls with v and n_cap and rises with the diameters,
/// wear rises with n_cap.  Their elasticities are the means of those of the part at the
/// limited spindle speed and of the rest, weighted by the share w of the rest,
///
///     time' = w (D' - v') - (1 - w) n_cap',
///     wear' = w (D' - v') + (1 - w) ((q - 1) n_cap' + q (D' - v')),  less f' and T'. (5)
///
/// Source: derived here under the integrals.
template <int N>
Duty<LogDual<N>> duty(const Sweep<LogDual<N>>& s, const LogDual<N>& vc_m_min,
                      const LogDual<N>& f_mm_rev, const LogDual<N>& life_min,
                      const LogDual<N>& n_cap_rpm, double taylor_n) {
  if (!s.tapered) {
    const auto time =
        s.D_large_mm * s.path_mm * (units::kPi / 1000) / (vc_m_min * f_mm_rev);
    return {time, time / life_min};
  }
  const double q = 1 / taylor_n;
  const auto &v = vc_m_min, &n = n_cap_rpm, &D1 = s.D_small_mm, &D2 = s.D_large_mm;
  const auto at = [&](double Interval::*D, double Interval::*speed,
                      double Interval::*cap) {
    return detail::split(std::exp(D1.ln.*D), std::exp(D2.ln.*D), std::exp(v.ln.*speed),
                         std::exp(n.ln.*cap), q);
  };
  constexpr auto lo = &Interval::lo, hi = &Interval::hi;
  const auto middle = detail::split(std::exp(D1.centre), std::exp(D2.centre),
                                    std::exp(v.centre), std::exp(n.centre), q);
  const auto most_clamped = at(lo, hi, lo), least_clamped = at(hi, lo, hi);
  const auto share = [&](double detail::Split::*part) {
    return Interval(
        most_clamped.unclamped / (most_clamped.unclamped + most_clamped.*part),
        least_clamped.unclamped / (least_clamped.unclamped + least_clamped.*part));
  };
  const Interval w = share(&detail::Split::clamped_time);
  const Interval u = share(&detail::Split::clamped_wear);
  typename LogDual<N>::Gradient time_d, wear_d;
  for (std::size_t j = 0; j < N; ++j) {
    const Interval free = (s.reaches_axis ? D2.d[j] : hull(D1.d[j], D2.d[j])) - v.d[j];
    const Interval cap = n.d[j], worn = Interval(q - 1) * cap + Interval(q) * free;
    time_d[j] = intersect(hull(free, -cap), -cap + w * (free + cap));
    wear_d[j] = intersect(hull(free, worn), worn + u * (free - worn));
  }
  const auto time = [](const detail::Split& x) { return x.clamped_time + x.unclamped; };
  const auto wear = [](const detail::Split& x) { return x.clamped_wear + x.unclamped; };
  const auto half = turnwright::detail::box_of(v, n);
  const auto per = s.path_mm / (f_mm_rev * (std::exp(D2.centre) - std::exp(D1.centre)));
  const auto minutes = detail::between<N>(time(at(lo, hi, hi)), time(at(hi, lo, lo)),
                                          time(middle), time_d, half);
  const auto worn = detail::between<N>(wear(at(lo, hi, lo)), wear(at(hi, lo, hi)),
                                       wear(middle), wear_d, half);
  return {per * minutes, per * worn / life_min};
}

}  // namespace turnwright::cutting
