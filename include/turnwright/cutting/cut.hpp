#pragma once
#include <cmath>
#include <optional>

#include "turnwright/base/log_dual.hpp"
#include "turnwright/catalogue/material.hpp"
#include "turnwright/catalogue/tool.hpp"

/// One tool in one material: chip, forces, tool life, roughness.  The functions are
/// templates over a scalar type, so that the same formula gives the number, its gradient
/// and its enclosure over a box.
namespace turnwright::cutting {

using catalogue::Kienzle;

/// Corner radius and tool cutting edge angle of a tool, with values derived from them.
struct Corner {
  double re_mm = 0, kapr_rad = 0;
  double sine = 0, cotangent = 0, half_tangent = 0;
  double depth_mm = 0;  ///< r (1 - cos kappa), beyond which the straight edge cuts, too
};
Corner corner_of(double re_mm, double kapr_rad);

/// Constants of a tool in a material, made by `cut_of`.
struct Cut {
  Kienzle kc;  ///< kc1.1 [MPa] times K_gamma, and mc
  catalogue::Thrust thrust;
  double land_N_mm = 0, land_Fc_N_mm = 0;  ///< of a worn edge: thrust, and along vc
  std::optional<Kienzle> kf, kp;           ///< if both, in place of `thrust`
  catalogue::Taylor taylor;
  Corner corner;
  double minor_kapr_rad = 0;
  double hmin_mm = 0;
  double land_Ra_um_mm = 0;   ///< Ra of the grooves in a wear land, per VB
  double land_Ra_um = 0;      ///< of a worn edge: Ra of those grooves
  double surface_factor = 1;  ///< 0.5 with a wiper edge
};

/// Least chip thickness of this tool in this material [mm].  Ploughing at a rounded edge
/// that is small against all else is similar at every radius r_n, so
///
///     hmin = hmin of the material r_n of the tool/r_n it belongs to                 (9)
///
/// where both radii are known; else it is the material's.
/// Source: derived here by similarity; not compared with measurements.
double hmin_mm(const catalogue::Material& material, const catalogue::Tool& tool);

/// Constants of this tool in this material.  The correction for the rake is
/// K_gamma = 1 - (gamma - gamma0)/100 with the angles in degrees, limited to 0.7 .. 1.3,
/// the range of this rule of thumb.
Cut cut_of(const catalogue::Material& material, const catalogue::Tool& tool);

/// The same tool with a wear land VB on its flank.  The work presses and rubs on the land
/// along the engaged edge,
///
///     F_D += p VB L,  Fc += mu p VB L,  p = Thrust::land_MPa, mu = 0.4               (8)
///
/// and the edge is changed there, though it would last until VB_end: with a land that
/// grows linearly Taylor's life is multiplied by VB/VB_end, C by (VB/VB_end)^n.
/// Source: derived here from a constant pressure; compared in docs/reality.md.  mu is an
/// estimate, with which Fc grows by half to two thirds at VB 0.3 mm, as measured.
/// The grooves in the land make a profile of their own, of Ra_land = w VB in (10), with w
/// the material's `land_Ra_um_mm`.
Cut worn(Cut cut, double VB_mm, double VB_end_mm);

/// Angle of an arc of the corner by its height x in units of the radius: acos(1 - x).
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
      [&](const Interval& ln) {
        return Interval(slope(angle(ln.lo)), slope(angle(ln.hi)));
      });
}

/// Engaged length L [mm] of an edge with corner radius r and tool cutting edge angle
/// kappa:
///
///     ap < r (1 - cos kappa):  L = r acos(1 - ap/r) + f/2                            (1)
///     else                     L = ap/sin(kappa) + r (kappa - tan(kappa/2)) + f/2    (2)
///
/// (1) is the arc alone, (2) the arc and the straight edge; they join with equal slope.
/// Valid for 0 < kappa < 133 deg (where kappa > tan(kappa/2)) and ap > 0.
/// Source: geometry of the corner, derived here; cut_test joins the two.
template <class T>
T engaged_edge_mm(const Cut& c, const T& ap_mm, const T& f_mm_rev) {
  const double r = c.corner.re_mm;
  const auto arc = [&](const T& ap) -> T { return r * arc_angle(T(ap / r)); };  // Eq. (1)
  const auto straight = [&](const T& ap) -> T {                                 // Eq. (2)
    return ap * (1 / c.corner.sine) + r * (c.corner.kapr_rad - c.corner.half_tangent);
  };
  if (!(r > 0)) return straight(ap_mm) + 0.5 * f_mm_rev;
  return branch(ap_mm, c.corner.depth_mm, arc, straight) + 0.5 * f_mm_rev;
}

/// Forces on the tool: cutting, feed and passive force [N].
template <class T>
struct Forces {
  T Fc_N{}, Ff_N{};
  Signed<T> Fp_N{};  ///< negative if it pulls the tool towards the work
};
template <int N>
struct Forces<LogDual<N>> {
  LogDual<N> Fc_N{}, Ff_N{};
  Dual<Interval, N> Fp_N{};
  std::optional<LogDual<N>> pushing_N = {};  ///< Fp where it pushes all over the box
};

/// Three forces of which all are positive.
template <class T>
Forces<T> pushing(const T& Fc_N, const T& Ff_N, const T& Fp_N) {
  return {Fc_N, Ff_N, Fp_N};
}
template <int N>
Forces<LogDual<N>> pushing(const LogDual<N>& Fc_N, const LogDual<N>& Ff_N,
                           const LogDual<N>& Fp_N) {
  return {Fc_N, Ff_N, linear(Fp_N), Fp_N};
}

/// Cutting force [N] by Kienzle's law for the equivalent chip b = L, h = ap f/L:
///
///     Fc = kc1.1 b h^(1-mc) K_gamma = kc1.1 K_gamma L^mc (ap f)^(1-mc)               (3)
///
/// Source: [Kienzle 1952]; equivalent chip thickness after [Woxen 1932].
template <class T>
T kienzle_N(const Kienzle& k, const T& L_mm, const T& ap_mm, const T& f_mm_rev) {
  using std::pow;
  const T A = ap_mm * f_mm_rev;
  if constexpr (is_point<T>) return k.k11_MPa * A * pow(L_mm / A, k.m);  // one power
  return k.k11_MPa * pow(L_mm, k.m) * pow(A, 1 - k.m);  // enclosed without error
}

/// u = cot(kappa_eff), where kappa_eff is the angle of the chip's flow, normal to the
/// chord of the engaged edge:
///
///     u = (x + f/2)/ap                                                               (4)
///     x/ap = sqrt(2 r/ap - 1) on the arc, cot(kappa) + (r/ap) tan(kappa/2) beyond
///
/// x is the axial extent of the edge; u < 0 where an edge with kappa > 90 deg pulls the
/// tool towards the work.
template <class T>
T flow_cotangent(const Cut& c, const T& ap_mm, const T& f_mm_rev) {
  using std::sqrt;
  const double r = c.corner.re_mm, k = r * c.corner.half_tangent;
  const double cotangent = c.corner.cotangent;
  const auto arc = [&](const T& ap) -> T {
    return sqrt(T(2 * r / ap) - T(1.0)) + 0.5 * f_mm_rev / ap;
  };
  const auto straight = [&](const T& ap) -> T {
    const T u = (0.5 * f_mm_rev + k) / ap;
    return cotangent < 0 ? T(u - T(-cotangent)) : T(u + cotangent);
  };
  return r > 0 ? branch(ap_mm, c.corner.depth_mm, arc, straight) : straight(ap_mm);
}

/// The three forces from the cutting force and the thrust force F_D by Eq. (6) below.
template <class T>
Forces<T> chip_flow_forces_N(const Cut& c, const T& Fc_N, const T& F_D, const T& ap_mm,
                             const T& f_mm_rev) {
  using std::sqrt;
  const T u = flow_cotangent(c, ap_mm, f_mm_rev);
  const T Ff = F_D / sqrt(sqr(u) + 1.0);
  return {Fc_N, Ff, Ff * u};
}
/// Enclosure of (6): by elasticities where u > 0; where the edge may pull the tool in, by
/// the values of sine and cosine at the ends of u.
template <int N>
Forces<LogDual<N>> chip_flow_forces_N(const Cut& c, const LogDual<N>& Fc_N,
                                      const LogDual<N>& F_D, const LogDual<N>& ap_mm,
                                      const LogDual<N>& f_mm_rev) {
  const auto sine = [](double u) { return 1 / std::hypot(1.0, u); };
  const double least = flow_cotangent(c, std::exp(ap_mm.ln.hi), std::exp(f_mm_rev.ln.lo));
  if (least > 0) {
    const auto ln_sine = [&](double ln_u) { return std::log(sine(std::exp(ln_u))); };
    // d ln sine/d ln u = -cosine^2
    const auto slope = [&](const Interval& ln_u) {
      return Interval(sqr(sine(std::exp(ln_u.hi))), sqr(sine(std::exp(ln_u.lo)))) -
             Interval(1);
    };
    const LogDual<N> u = flow_cotangent(c, ap_mm, f_mm_rev);
    const auto cosine = monotone(
        u, [&](double ln_u) { return ln_u + ln_sine(ln_u); },
        [&](const Interval& ln_u) { return slope(ln_u) + Interval(1); });
    return pushing(Fc_N, LogDual<N>(F_D * monotone(u, ln_sine, slope)),
                   LogDual<N>(F_D * cosine));
  }
  const auto u = flow_cotangent(c, linear(ap_mm), linear(f_mm_rev));
  const double most = std::max(std::abs(u.v.lo), std::abs(u.v.hi));
  const double nearest =
      u.v.lo <= 0 && u.v.hi >= 0 ? 0 : std::min(std::abs(u.v.lo), std::abs(u.v.hi));
  const Interval s(sine(most), sine(nearest));
  LogDual<N> Ff;
  Ff.ln = F_D.ln + log(s);
  Ff.centre = turnwright::detail::kUnknown;
  for (std::size_t j = 0; j < N; ++j) Ff.d[j] = F_D.d[j] - sqr(s) * u.v * u.d[j];
  const auto cosine = turnwright::detail::chain(
      Interval(u.v.lo * sine(u.v.lo), u.v.hi * sine(u.v.hi)), s * sqr(s), u);
  return {Fc_N, Ff, linear(F_D) * cosine};
}

/// All three forces, divided by `per`.  Ff and Fp follow from the material's own kf1.1
/// and kp1.1 where it has them, and otherwise from the thrust force F_D (ISO 3002-4: the
/// part of the cutting force normal to the cutting speed) in the direction of chip flow:
///
///     F_D = lambda Fc + ke L                                                         (5)
///     Ff = F_D sin(kappa_eff),  Fp = F_D cos(kappa_eff)                              (6)
///
/// The first term of (5) makes the chip, the second is the ploughing of the rounded edge
/// along its length L, whatever the thickness of the chip; so F_D/Fc rises as the chip
/// becomes thin.  Constants and their uncertainty: catalogue::Thrust.
/// A worn edge adds (8).
/// Source: direction [Colwell 1954]; edge force [Albrecht 1960].  Compared with measured
/// cuts in docs/reality.md.
template <class T>
Forces<T> forces_N(const Cut& c, const T& ap_mm, const T& f_mm_rev,
                   const T& per = T(1.0)) {
  const T L = engaged_edge_mm(c, ap_mm, f_mm_rev);
  const auto force = [&](const Kienzle& k) -> T {  // Eq. (3)
    return kienzle_N(k, L, ap_mm, f_mm_rev) / per;
  };
  const auto along = [&](double N_mm) -> T { return N_mm * L / per; };
  const T chip = force(c.kc);
  const T Fc = c.land_Fc_N_mm > 0 ? T(chip + along(c.land_Fc_N_mm)) : chip;
  if (c.kf && c.kp) {
    const Forces<T> F = pushing(Fc, force(*c.kf), force(*c.kp));
    if (!(c.land_N_mm > 0)) return F;
    const auto land = chip_flow_forces_N(c, Fc, along(c.land_N_mm), ap_mm, f_mm_rev);
    return {Fc, F.Ff_N + land.Ff_N, F.Fp_N + land.Fp_N};
  }
  const double edge_N_mm = c.thrust.edge_N_mm + c.land_N_mm;
  const T by_chip = c.thrust.ratio * chip;  // Eq. (5)
  return chip_flow_forces_N(
      c, Fc, edge_N_mm > 0 ? T(by_chip + along(edge_N_mm)) : by_chip, ap_mm, f_mm_rev);
}

/// The same without ploughing and wear land.
template <class T>
Forces<T> chip_forces_N(Cut c, const T& ap_mm, const T& f_mm_rev) {
  c.thrust.edge_N_mm = c.land_N_mm = c.land_Fc_N_mm = 0;
  return forces_N(c, ap_mm, f_mm_rev);
}

/// Stiffnesses of regenerative chatter [N/mm]: forces per motion of the edge relative to
/// the surface of the turn before, w out of the work and z against the feed.  They change
/// the chip's section A = ap f,
///
///     dA = -((x + f/2) dw + ap dz) = -ap (u dw + dz)
///
/// x + f/2 is the edge's axial extent, u = cot(kappa_eff) of (4), ap its radial extent.  A
/// motion along the cutting speed leaves A as it is.  With the forces Fp', Ff' that make
/// the chip, (5) without ploughing, which does not depend on the surface of the turn
/// before, and (6), by which they lie across the chord like A's slope,
///
///     K_zz = Ff'/f,  K_wz = (Fp' + u Ff')/(2 f) = u K_zz,  K_ww = Fp' u/f = u^2 K_zz   (7)
///
/// so that static compliances c of work and tool have the loop gain
/// K_ww c_ww + 2 K_wz c_wz + K_zz c_zz.  A material with kp1.1 has the first form of K_wz
/// and K_ww, with all of its Ff and Fp.  The wave w' of the turn before changes the section
/// by (x - f/2) w'; x + f/2 in its place is on the safe side.  The slope of (3) at constant
/// b is (1 - mc) of K, so the secant K is on the safe side, too.
/// Source: derived here; cut_test measures the sections of two profiles.
template <class T>
struct ChatterStiffness {
  Signed<T> ww{}, wz{}, zz{};
};

/// K_ww of (7).
template <class T>
Signed<T> chatter_stiffness_N_mm(const Cut& c, const T& ap_mm, const T& f_mm_rev) {
  return chip_forces_N(c, ap_mm, f_mm_rev).Fp_N * flow_cotangent(c, ap_mm, f_mm_rev) /
         f_mm_rev;
}
/// Its enclosure, by elasticities where u > 0.
template <int N>
Dual<Interval, N> chatter_stiffness_N_mm(const Cut& c, const LogDual<N>& ap_mm,
                                         const LogDual<N>& f_mm_rev) {
  const double least = flow_cotangent(c, std::exp(ap_mm.ln.hi), std::exp(f_mm_rev.ln.lo));
  if (!(least > 0))
    return chip_forces_N(c, ap_mm, f_mm_rev).Fp_N *
           flow_cotangent(c, linear(ap_mm), linear(f_mm_rev)) / linear(f_mm_rev);
  const LogDual<N> u = flow_cotangent(c, ap_mm, f_mm_rev);
  const LogDual<N> L = engaged_edge_mm(c, ap_mm, f_mm_rev);
  if (c.kf && c.kp) return linear(kienzle_N(*c.kp, L, ap_mm, f_mm_rev) * u / f_mm_rev);
  // u cos(kappa_eff) = u^2/sqrt(1 + u^2), of elasticity 1 + 1/(1 + u^2)
  const LogDual<N> flow = monotone(
      u, [](double ln_u) { return 2 * ln_u - std::log(std::hypot(1.0, std::exp(ln_u))); },
      [](const Interval& ln_u) {
        return Interval(1 + 1 / (1 + std::exp(2 * ln_u.hi)),
                        1 + 1 / (1 + std::exp(2 * ln_u.lo)));
      });
  return linear(c.thrust.ratio * kienzle_N(c.kc, L, ap_mm, f_mm_rev) * flow / f_mm_rev);
}

/// All of (7).
template <class T>
ChatterStiffness<T> chatter_stiffnesses_N_mm(const Cut& c, const T& ap_mm,
                                             const T& f_mm_rev) {
  const Forces<T> F = chip_forces_N(c, ap_mm, f_mm_rev);
  const Signed<T> f = linear(f_mm_rev);
  ChatterStiffness<T> K;
  K.ww = chatter_stiffness_N_mm(c, ap_mm, f_mm_rev);
  K.wz = F.Fp_N / f;
  K.zz = linear(T(F.Ff_N / f_mm_rev));
  if (c.kf && c.kp) K.wz = (K.wz + K.zz * flow_cotangent(c, linear(ap_mm), f)) * 0.5;
  return K;
}

/// ap^b, with the material's other exponent below 1 mm where it has one.
template <class T>
T depth_power(const catalogue::Taylor& t, const T& ap_mm) {
  using std::pow;
  if (!t.b_shallow) return pow(ap_mm, t.b);
  return branch(
      ap_mm, 1.0, [&](const T& ap) -> T { return pow(ap, *t.b_shallow); },
      [&](const T& ap) -> T { return pow(ap, t.b); });
}

/// Tool life [min], T = (C/(vc f^a ap^b))^(1/n).  Source: [Taylor 1907], extended form.
template <class T>
T tool_life_min(const Cut& c, const T& vc_m_min, const T& f_mm_rev, const T& ap_mm) {
  using std::pow;
  const auto& t = c.taylor;
  return pow(t.C / (vc_m_min * pow(f_mm_rev, t.a) * depth_power(t, ap_mm)), 1 / t.n);
}

/// Cutting speed [m/min] that gives the life T [min]: the same law solved for vc.
template <class T, class Life>
T speed_for_life_m_min(const Cut& c, const Life& T_min, const T& f_mm_rev,
                       const T& ap_mm) {
  using std::pow;
  const auto& t = c.taylor;
  return t.C * pow(T_min, -t.n) / (pow(f_mm_rev, t.a) * depth_power(t, ap_mm));
}

/// Roughness Rz [um] that the corner radius generates, with the floor by the least chip
/// thickness hmin:
///
///     Rt = f^2/(8 r) + (hmin/2)(1 + r hmin/f^2),  least value hmin at f = sqrt(2 r hmin)
///
/// times the wiper factor.  Exact for f <= 2 r sin(kappa'); at greater feeds the straight
/// minor edge lies below the arc's continuation and cuts off the ridge, so the formula is
/// on the safe side.  Source: [Brammertz 1961].
template <class T>
T feed_Rz_um(const Cut& c, const T& f_mm_rev) {
  const double r = c.corner.re_mm, h = c.hmin_mm;
  T Rt = sqr(f_mm_rev) * (1 / (8 * r));
  if (h > 0) Rt = Rt + 0.5 * h + (0.5 * r * h * h) / sqr(f_mm_rev);
  return Rt * (1000 * c.surface_factor);
}

/// Roughness of a profile with that of the wear land's grooves on it.  Two profiles that know
/// nothing of each other add by the squares of their Rq; Ra and Rz are taken in proportion,
///
///     R = sqrt(R_feed^2 + R_land^2)                                                 (10)
///
/// Source: derived here; compared with measured shafts in docs/reality.md.
template <class T>
T with_land_um(const T& feed_um, double land_um) {
  using std::sqrt;
  return land_um > 0 ? T(sqrt(T(sqr(feed_um) + sqr(land_um)))) : feed_um;
}

/// Rz [um] of the feed's profile and of the land's, whose Rz is 4.5 Ra, as measured on
/// worn and on new edges alike [Pereira 2025].
template <class T>
T Rz_um(const Cut& c, const T& f_mm_rev) {
  constexpr double kRz_Ra = 4.5;
  return with_land_um(feed_Rz_um(c, f_mm_rev), kRz_Ra * c.land_Ra_um);
}

/// Ra [um] of the parabolic profile, Rt 8/(18 sqrt 3), which is f^2/(18 sqrt(3) r)
/// without the floor, and of the land's.
template <class T>
T Ra_um(const Cut& c, const T& f_mm_rev) {
  return with_land_um(T(feed_Rz_um(c, f_mm_rev) * (8 / (18 * std::sqrt(3.0)))),
                      c.land_Ra_um);
}

/// Tool life of least cost [min]: (1/n - 1)(t_change + c_edge/c_minute), with the
/// objective's weights of an edge and of a minute.  Source: d cost/d vc = 0.
double economic_life_min(const Cut& c, double change_min, double edge_over_minute);

}  // namespace turnwright::cutting
