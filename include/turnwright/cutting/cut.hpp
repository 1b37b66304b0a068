#pragma once
#include <cmath>

#include "turnwright/base/log_dual.hpp"
#include "turnwright/catalogue/material.hpp"
#include "turnwright/catalogue/tool.hpp"
#include "turnwright/optimise/curvature.hpp"

/// One tool in one material: chip, forces, tool life, surface.  Functions are written
/// over a scalar type, so that the same line gives the number, its gradient, its
/// enclosure over a box and its curvature.
namespace turnwright::cutting {

using catalogue::Kienzle;

/// Constants of a cut, made by `cut_of`.
struct Cut {
  Kienzle kc;  ///< kc1.1 [MPa] times K_gamma, and mc
  std::optional<Kienzle> kf, kp;
  catalogue::Taylor taylor;
  double kapr_rad = 0, minor_kapr_rad = 0, re_mm = 0;
  double hmin_mm = 0;
  double surface_factor = 1;  ///< 0.5 with a wiper edge
};

/// K_gamma = 1 - (gamma - gamma0)/100 with the angles in degrees, held at 0.7 .. 1.3,
/// where the rule of thumb ends.
Cut cut_of(const catalogue::Material& material, const catalogue::Tool& tool);

/// Depth [mm] at which the engaged edge leaves the corner arc, r (1 - cos kappa).
inline double corner_depth_mm(const Cut& c) {
  return c.re_mm * (1 - std::cos(c.kapr_rad));
}

/// Angle of an arc of the corner from its height over the radius: acos(1 - x).
template <class T>
T arc_angle(const T& x) {
  using std::acos;
  return acos(1.0 - x);
}
/// Its elasticity tan(theta/2)/theta rises with theta.
template <int N>
LogDual<N> arc_angle(const LogDual<N>& x) {
  const auto angle = [](double ln) { return std::acos(1 - std::min(std::exp(ln), 2.0)); };
  const auto slope = [](double theta) {
    return theta > 0 ? std::tan(theta / 2) / theta : 0.5;
  };
  return monotone(
      x, [&](double ln) { return std::log(angle(ln)); },
      [&](const Interval& ln) { return Interval(slope(angle(ln.lo)), slope(angle(ln.hi))); });
}

/// Engaged edge L [mm] of a corner radius r and tool cutting edge angle kappa:
///
///     ap < r (1 - cos kappa):  L = r acos(1 - ap/r) + f/2                            (1)
///     else                     L = ap/sin(kappa) + r (kappa - tan(kappa/2)) + f/2    (2)
///
/// which are the arc and the arc with the straight edge; they meet with equal slope.
/// Valid for 0 < kappa < 133 deg (where kappa > tan(kappa/2)) and ap > 0.
/// Source: geometry of the corner, derived here; cut_test joins the two.
template <class T>
T engaged_edge_mm(const Cut& c, const T& ap_mm, const T& f_mm_rev) {
  const double r = c.re_mm, kappa = c.kapr_rad;
  const auto arc = [&](const T& ap) -> T { return r * arc_angle(T(ap / r)); };  // Eq. (1)
  const auto straight = [&](const T& ap) -> T {                                // Eq. (2)
    return ap * (1 / std::sin(kappa)) + r * (kappa - std::tan(kappa / 2));
  };
  if (!(r > 0)) return straight(ap_mm) + 0.5 * f_mm_rev;
  return branch(ap_mm, corner_depth_mm(c), arc, straight) + 0.5 * f_mm_rev;
}

/// L is log-convex: (1) is sqrt(2 r ap) times a power series with positive coefficients,
/// (2) a posynomial, and the slope d ln L/d ln ap does not fall where they meet.
inline optimise::LogCurvature engaged_edge_mm(const Cut&,
                                              const optimise::LogCurvature& ap,
                                              const optimise::LogCurvature& f) {
  return ap.affine() && f.affine() ? ap + f : optimise::LogCurvature();
}

/// Forces on the tool: cutting, feed and passive force [N].
template <class T>
struct Forces {
  T Fc_N{}, Ff_N{};
  Signed<T> Fp_N{};  ///< may pull the tool in
};

/// Cutting force [N] by Kienzle on the equivalent chip b = L, h = ap f/L:
///
///     Fc = kc1.1 b h^(1-mc) K_gamma = kc1.1 K_gamma L^mc (ap f)^(1-mc)               (3)
///
/// Source: Kienzle (1952); equivalent chip thickness after Brammertz/Woxen.
template <class T>
T kienzle_N(const Kienzle& k, const T& L_mm, const T& ap_mm, const T& f_mm_rev) {
  using std::pow;
  return k.k11_MPa * pow(L_mm, k.m) * pow(ap_mm * f_mm_rev, 1 - k.m);
}

/// Direction of the chip's flow: sine and cosine of kappa_eff.
template <class T>
struct Flow {
  T sine{};
  Signed<T> cosine{};
};

/// From its cotangent.
template <class T>
Flow<T> flow(const T& u) {
  using std::sqrt;
  const T sine = 1.0 / sqrt(sqr(u) + 1.0);
  return {sine, u * sine};
}
/// Both are monotone in u (the sine in its size): their ends enclose them.
template <int N>
Flow<LogDual<N>> flow(const Dual<Interval, N>& u) {
  const auto ln_sine = [](double x) { return -0.5 * std::log1p(x * x); };
  const auto slope = [](double x) { return -x / (1 + x * x); };  // of ln sine, -1/2 .. 1/2
  const double size = std::max(std::abs(u.v.lo), std::abs(u.v.hi));
  const bool both = u.v.lo <= 0 && u.v.hi >= 0;
  Flow<LogDual<N>> r;
  r.sine.ln = {ln_sine(size),
               both ? 0.0 : ln_sine(std::min(std::abs(u.v.lo), std::abs(u.v.hi)))};
  r.sine.centre = turnwright::detail::kUnknown;
  Interval d(std::min(slope(u.v.lo), slope(u.v.hi)),
             std::max(slope(u.v.lo), slope(u.v.hi)));
  if (u.v.lo <= 1 && u.v.hi >= 1) d.lo = -0.5;
  if (u.v.lo <= -1 && u.v.hi >= -1) d.hi = 0.5;
  for (std::size_t j = 0; j < N; ++j) r.sine.d[j] = d * u.d[j];
  const Interval s = exp(r.sine.ln);
  r.cosine = turnwright::detail::chain(
      Interval(u.v.lo / std::hypot(1.0, u.v.lo), u.v.hi / std::hypot(1.0, u.v.hi)),
      s * sqr(s), u);
  return r;
}

/// cot(kappa_eff) = u = (x + f/2)/ap                                                  (5)
///
///     x/ap = sqrt(2 r/ap - 1) on the arc, cot(kappa) + (r/ap) tan(kappa/2) beyond
///
/// x is the axial extent of the edge.
template <class T>
Signed<T> flow_cotangent(const Cut& c, const T& ap_mm, const T& f_mm_rev) {
  using std::sqrt;
  const double r = c.re_mm, kappa = c.kapr_rad;
  const Signed<T> ap = linear(ap_mm);
  const auto arc = [&](const Signed<T>& a) -> Signed<T> { return sqrt(2 * r / a - 1.0); };
  const auto straight = [&](const Signed<T>& a) -> Signed<T> {
    return r * std::tan(kappa / 2) / a + 1 / std::tan(kappa);
  };
  const Signed<T> x = r > 0 ? branch(ap, corner_depth_mm(c), arc, straight) : straight(ap);
  return x + 0.5 * linear(T(f_mm_rev / ap_mm));
}
inline optimise::LogCurvature flow_cotangent(const Cut&, const optimise::LogCurvature&,
                                             const optimise::LogCurvature&) {
  return {};
}

/// All three forces.  Ff and Fp by the material's own kf1.1 and kp1.1 where it has them;
/// else by the chip-flow direction, normal to the chord of the engaged edge:
///
///     F_D = 0.5 Fc,  Ff = F_D sin(kappa_eff),  Fp = F_D cos(kappa_eff)               (4)
///
/// Carried with +-30 %.
/// Source: Colwell (1954), "Predicting the angle of chip flow".
template <class T>
Forces<T> forces_N(const Cut& c, const T& ap_mm, const T& f_mm_rev) {
  const T L = engaged_edge_mm(c, ap_mm, f_mm_rev);
  const T Fc = kienzle_N(c.kc, L, ap_mm, f_mm_rev);  // Eq. (3)
  if (c.kf && c.kp)
    return {Fc, kienzle_N(*c.kf, L, ap_mm, f_mm_rev),
            linear(kienzle_N(*c.kp, L, ap_mm, f_mm_rev))};
  const Flow<T> chip = flow(flow_cotangent(c, ap_mm, f_mm_rev));
  const T F_D = 0.5 * Fc;
  return {Fc, F_D * chip.sine, linear(F_D) * chip.cosine};  // Eq. (4)
}

/// Tool life [min], T = (C/(vc f^a ap^b))^(1/n).  Source: Taylor (1907), extended form.
template <class T>
T tool_life_min(const Cut& c, const T& vc_m_min, const T& f_mm_rev, const T& ap_mm) {
  using std::pow;
  const auto& t = c.taylor;
  return pow(t.C / (vc_m_min * pow(f_mm_rev, t.a) * pow(ap_mm, t.b)), 1 / t.n);
}

/// Cutting speed [m/min] that gives the life T [min]: the same law solved for vc.
template <class T>
T speed_for_life_m_min(const Cut& c, double T_min, const T& f_mm_rev, const T& ap_mm) {
  using std::pow;
  const auto& t = c.taylor;
  return t.C * std::pow(T_min, -t.n) / (pow(f_mm_rev, t.a) * pow(ap_mm, t.b));
}

/// Roughness depth Rz [um] of the corner radius, with Brammertz' floor:
///
///     Rt = f^2/(8 r) + (hmin/2)(1 + r hmin/f^2),   least value hmin at f = sqrt(2 r
///     hmin)
///
/// times the wiper factor.  Exact for f <= 2 r sin(kappa'); beyond, the straight minor edge
/// lies below the arc's continuation and shaves the ridge, so the formula stays safe.
/// Source: Brammertz (1961).
template <class T>
T Rz_um(const Cut& c, const T& f_mm_rev) {
  const double r = c.re_mm, h = c.hmin_mm;
  T Rt = sqr(f_mm_rev) * (1 / (8 * r));
  if (h > 0) Rt = Rt + 0.5 * h + (0.5 * r * h * h) / sqr(f_mm_rev);
  return Rt * (1000 * c.surface_factor);
}

/// Ra [um]: for the parabolic profile Ra = Rt 8/(18 sqrt 3), f^2/(18 sqrt(3) r) without
/// the floor.
template <class T>
T Ra_um(const Cut& c, const T& f_mm_rev) {
  return Rz_um(c, f_mm_rev) * (8 / (18 * std::sqrt(3.0)));
}

/// Life [min] of least cost: (1/n - 1)(t_change + c_edge/c_minute), where w_edge/w_minute
/// are the objective's weights of an edge and a minute.  Source: d cost/d vc = 0.
double economic_life_min(const Cut& c, double change_min, double edge_over_minute);

}  // namespace turnwright::cutting
