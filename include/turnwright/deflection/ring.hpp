#pragma once
#include <algorithm>
#include <cmath>

namespace turnwright::deflection {

/// A ring or tube squeezed by equal radial forces F at n equally spaced jaws.  The radial
/// displacement, positive inwards, at the angle t from a jaw is
///
///     w(t) = n F R^3/(pi E I) sum_(m = n, 2n, 3n, ..) cos(m t)/(m^2 - 1)^2         (1)
///
/// The sum is, with alpha = pi/n and phi = t - alpha counted from the middle between two
/// jaws, |phi| <= alpha,
///
///     w = F R^3/(2 E I) (phi sin(phi)/(2 sin(alpha)) - 1/alpha
///                        + cos(phi) (sin(alpha) + alpha cos(alpha))/(2 sin^2(alpha)))
///                                                                                  (2)
///
/// With three jaws it differs by 0.0302 F R^3/(E I) between a jaw and the middle.  A
/// surface that is turned round under the jaws has these lobes inverted after release:
/// it is high where it had been pressed in.
///
/// Symbols: R mean radius of the ring [mm]; E I bending stiffness of its wall [N mm^2],
/// E b t^3/12 for a ring of width b and wall t (E/(1 - nu^2) for a long tube).
/// Valid for thin rings: shear in the wall adds 2.3 (t/R)^2 of the lobes (nu = 0.3, three
/// jaws), so 2 % at t = 0.1 R and 9 % at t = 0.2 R; the uniform squeeze (m = 0) and
/// friction at the jaws are neglected.
/// In a tube the lobes of n jaws at its end decay beyond them as exp(-lambda s),
///
///     lambda = sqrt[n^2 (n^2 - 1) t/(sqrt(48) R)]/R                                (3)
///
/// Source: derived here, (1) from the bending energy of the modes of an inextensible
/// ring, (2) from w'' + w = (F R^3/2 E I) (cos(phi)/sin(alpha) - 1/alpha); compared in
/// ring_test.  (3) from the energies of a mode cos(n t) of a tube that neither stretches
/// around nor shears (v = w/n, u = R w'/n^2): a beam of stiffness E t R^2/n^4 on a
/// foundation E t^3 (n^2 - 1)^2/(12 R^4), lambda^4 = foundation/(4 stiffness).
struct Ring {
  double R_mm = 0;
  double EI_Nmm2 = 0;
};

/// Bending stiffness E I of a wall of the given thickness and width.
/// @throws std::domain_error unless all are positive.
double wall_EI_Nmm2(double E_MPa, double width_mm, double wall_mm);

/// Displacement by Eq. (2) [mm].  @throws std::domain_error unless R, E I > 0, jaws >= 2.
double squeeze_mm(const Ring& ring, int jaws, double jaw_force_N, double angle_rad);

/// Peak to valley of the radius over the ring [mm].
double lobing_mm(const Ring& ring, int jaws, double jaw_force_N);

/// The ring with the shear of a wall that is not thin: E I/(1 + 2.3 (t/R)^2).
Ring with_shear(const Ring& ring, double wall_mm);

/// Stress [MPa] around a wall at its inner and outer surface, tension positive.
struct WallStress {
  double inner_MPa = 0, outer_MPa = 0;
  double largest_MPa() const {
    return std::max(std::abs(inner_MPa), std::abs(outer_MPa));
  }
};

/// Of a curved wall of a given width, by a couple M that opens it (tension inside):
///
///     sigma(r) = M (r_n - r)/(b t e r),  r_n = t/ln(r_o/r_i),  e = R - r_n           (4)
///
/// Source: Winkler and Bach; within 0.5 % inside and 3.2 % outside of the exact solution
/// for r_o/r_i <= 3 [Timoshenko and Goodier 1970, art. 29].
/// @throws std::domain_error unless 0 < inner < outer and the width is positive.
WallStress bent_wall(double inner_mm, double outer_mm, double width_mm, double M_Nmm);

/// The largest stress in a ring squeezed by n jaws.  Under a jaw and in the middle between
/// two of them the wall has, from (2), the couples and the compressive forces
///
///     M = F R/2 (1/alpha - cot(alpha)), N = F/2 cot(alpha);
///     M = F R/2 (1/alpha - 1/sin(alpha)), N = F/2/sin(alpha)                         (5)
///
/// Source: derived here from the curvature of (2); [Young and Budynas 2002, table 9.2,
/// case 7].  The pressure of the jaw itself is not in it.
/// @throws std::domain_error as above, and unless jaws >= 2.
WallStress squeezed_wall(double inner_mm, double outer_mm, double width_mm, int jaws,
                         double jaw_force_N);

/// Decay rate lambda of Eq. (3) [1/mm].  @throws std::domain_error unless R, t > 0,
/// jaws >= 2.
double lobe_decay_1_mm(double R_mm, double wall_mm, int jaws);

}  // namespace turnwright::deflection
