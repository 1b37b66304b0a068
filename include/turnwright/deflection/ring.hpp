#pragma once

namespace turnwright::deflection {

/// A ring or tube squeezed by equal radial forces F at n even jaws: radial displacement,
/// inwards positive, at the angle t from a jaw,
///
///     w(t) = n F R^3/(pi E I) sum_(m = n, 2n, 3n, ..) cos(m t)/(m^2 - 1)^2         (1)
///
/// whose sum is, with alpha = pi/n, phi = t - alpha counted from the middle between two
/// jaws, |phi| <= alpha,
///
///     w = F R^3/(2 E I) (phi sin(phi)/(2 sin(alpha)) - 1/alpha
///                        + cos(phi) (sin(alpha) + alpha cos(alpha))/(2 sin^2(alpha)))
///                                                                                  (2)
///
/// From jaw to middle, three jaws: 0.0302 F R^3/(E I).  Turned round under the jaws and
/// let go, the surface keeps these lobes the other way round: high where it had been
/// pressed in.
///
/// Symbols: R mean radius of the ring [mm]; E I of its wall against ovalising [N mm^2],
/// E b t^3/12 for a ring of width b and wall t (E/(1 - nu^2) for a long tube).
/// Valid for thin rings: shear in the wall adds 2.3 (t/R)^2 of the lobes (nu = 0.3, three
/// jaws), so 2 % at t = 0.1 R and 9 % at t = 0.2 R; the even squeeze (m = 0) and friction
/// at the jaws are left out.
/// In a tube the lobes of n jaws at its end die away beyond them as exp(-lambda s),
///
///     lambda = sqrt[n^2 (n^2 - 1) t/(sqrt(48) R)]/R                                (3)
///
/// Source: derived here, (1) from the bending energy of the modes of a ring that does not
/// stretch, (2) from w'' + w = (F R^3/2 E I) (cos(phi)/sin(alpha) - 1/alpha); compared in
/// ring_test.  (3) from the energies of a mode cos(n t) of a tube that neither stretches
/// around nor shears (v = w/n, u = R w'/n^2): a beam of stiffness E t R^2/n^4 on a
/// foundation E t^3 (n^2 - 1)^2/(12 R^4), lambda^4 = foundation/(4 stiffness).
struct Ring {
  double R_mm = 0;
  double EI_Nmm2 = 0;
};

/// E I of a wall of thickness t and width b that bends in its plane.
/// @throws std::domain_error unless all are positive.
double wall_EI_Nmm2(double E_MPa, double width_mm, double wall_mm);

/// Eq. (2) [mm].  @throws std::domain_error unless R, E I > 0 and jaws >= 2.
double squeeze_mm(const Ring& ring, int jaws, double jaw_force_N, double angle_rad);

/// Peak to valley of the radius over the ring [mm].
double lobing_mm(const Ring& ring, int jaws, double jaw_force_N);

/// A tube's wall by its shear, for walls that are not thin: E I/(1 + 2.3 (t/R)^2).
Ring with_shear(const Ring& ring, double wall_mm);

/// Eq. (3) [1/mm].  @throws std::domain_error unless R, t > 0 and jaws >= 2.
double lobe_decay_1_mm(double R_mm, double wall_mm, int jaws);

}  // namespace turnwright::deflection
