#pragma once
#include <algorithm>

#include "operation_model.hpp"
#include "planning/limits/check.hpp"

/// The limits of an operation as pairs of a value and the limit that it keeps.
namespace turnwright::planning {

/// Hands every check that does not depend on the speed to sink(check, value, limit).  Here
/// and below F is limiting_forces.
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
  const auto widest = limiting_sweep(o, o.widest(), a);
  for (const auto& l : o.range.lines)
    if (cutting::constant_torque(l))
      sink(l.torque ? Check::torque : Check::power,
           cutting::power_share(l, F.Fc_N, widest, T(1.0), T(o.n_cap_rpm)), T(1.0));
  if (o.Ra_um > 0) sink(Check::Ra, cutting::Ra_um(o.cut, f), T(o.Ra_um));
  if (o.Rz_um > 0) sink(Check::Rz, cutting::Rz_um(o.cut, f), T(o.Rz_um));
}

/// Gain of the regenerative loop from what the edge yields along the feed, (7) of
/// cutting/cut.hpp, and that of its coupling with the radial motion.
template <class T>
struct AlongFeed {
  Signed<T> alone{}, coupled{};
  bool coupling = false;  ///< counts where it adds
};
template <class T>
AlongFeed<T> along_feed(const OperationModel& o, const T& f, const T& a) {
  if (!(o.chatter_zz_mm_N > 0)) return {Signed<T>(0.0), Signed<T>(0.0)};
  const auto K = cutting::chatter_stiffnesses_N_mm(o.cut, T(o.depth_mm(a)), f);
  return {K.zz * o.chatter_zz_mm_N, K.wz * (2 * o.chatter_wz_mm_N),
          o.chatter_wz_mm_N != 0};
}

/// Hands every gain of a place to sink, of which each is held against 1: K_ww times its
/// compliance C_ww, and what comes on top along the feed.  Where K_ww < 0, -K_ww counts in
/// the proportion of both limits.
template <class T, class Sink>
void chatter_gains(const OperationModel& o, const Signed<T>& radial,
                   const AlongFeed<T>& along, const Sink& sink) {
  const bool pushed = o.cut.kp && o.cut.corner.cotangent < 0;  // K_ww < 0 may be
  if (!(o.chatter_zz_mm_N > 0)) {
    sink(radial);
    if (pushed) sink(Signed<T>(radial * -o.chatter_inwards));
    return;
  }
  const Signed<T> apart = radial + along.alone;
  sink(apart);
  if (along.coupling) sink(Signed<T>(apart + along.coupled));
  if (pushed) sink(Signed<T>(radial * -o.chatter_inwards + along.alone));
}

/// The largest gain at conditions, where the radial compliance is C_ww.
inline double chatter_gain(const OperationModel& o, double f, double a, double ww_mm_N) {
  const double K = cutting::chatter_stiffness_N_mm(o.cut, o.depth_mm(a), f);
  double most = 0;
  chatter_gains<double>(o, K * ww_mm_N, along_feed(o, f, a),
                        [&](double gain) { most = std::max(most, gain); });
  return most;
}

/// And chatter, in terms of either sign: the gains at each place.
template <class T, class Sink>
void chatter_checks(const OperationModel& o, std::size_t operation, const T& f,
                    const T& a, const Sink& sink) {
  if (o.chatter_mm_N.empty()) return;
  const Signed<T> K = cutting::chatter_stiffness_N_mm(o.cut, o.depth_mm(a), f);
  const auto along = along_feed(o, f, a);
  for (const auto& c : o.chatter_mm_N)
    chatter_gains<T>(o, Signed<T>(K * c(linear(a))), along, [&](const Signed<T>& gain) {
      sink(operation, Check::chatter, false, gain, Signed<T>(1.0));
    });
}

/// And every check of the speed.
template <class T, class Sink>
void speed_checks(const OperationModel& o, const T& v, const T& f, const T& a,
                  const cutting::Forces<T>& F, const T& n_cap, const Sink& sink) {
  const auto widest = limiting_sweep(o, o.widest(), a),
             narrowest = limiting_sweep(o, o.narrowest(), a);
  for (const auto& l : o.range.lines)
    if (!cutting::constant_torque(l))
      sink(l.torque ? Check::torque : Check::power,
           cutting::power_share(l, F.Fc_N, l.s >= 0 ? widest : narrowest, v, n_cap),
           T(1.0));
  sink(Check::vc_min, T(o.vc_window.lower), v);
  sink(Check::vc_max, v, T(o.vc_window.upper));
  const T life = cutting::tool_life_min(o.cut, v, f, limiting_depth_mm(o, a));
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
  const auto widest = limiting_sweep(o, o.widest(), a),
             narrowest = limiting_sweep(o, o.narrowest(), a);
  const T ap = limiting_depth_mm(o, a);
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

}  // namespace turnwright::planning
