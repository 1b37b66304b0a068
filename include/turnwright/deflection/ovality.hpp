#pragma once
#include <span>

#include "turnwright/deflection/beam.hpp"

namespace turnwright::deflection {

/// Area and moments of a section about the axis of rotation; x and y turn with the part:
/// sx = int x dA, xx = int x^2 dA, xy = int x y dA.
struct Section {
  double area_mm2 = 0;
  double sx_mm3 = 0, sy_mm3 = 0;
  double xx_mm4 = 0, yy_mm4 = 0, xy_mm4 = 0;
};

/// A disc or ring.  @throws std::domain_error unless outer > inner >= 0.
Section round_section(double outer_mm, double inner_mm = 0);

/// A slot milled out of the rim, of the given width, in the direction of the given angle.
/// A flat at a distance h from the axis is a slot of the width 2 sqrt(R^2 - h^2).
struct Slot {
  double width_mm = 0;
  double floor_mm = 0;  ///< distance of the floor from the axis
  double angle_rad = 0;
};

/// The section less a slot in the rim of its disc, |y| < c = b/2,
/// floor < x < sqrt(R^2 - y^2).  With X = sqrt(R^2 - c^2), phi = asin(c/R),
/// W = c X + R^2 phi and r the floor, the slot has
///
///     A = W - 2 c r,                 sx = c (R^2 - r^2) - c^3/3
///     xx = c X^3/6 + R^2 W/4 - 2 c r^3/3,  yy = -c X^3/2 + R^2 W/4 - 2 c^3 r/3   (1)
///
/// Source: derived here by integrating over x, then y.  The slot must not reach the bore
/// or another slot.
/// @throws std::domain_error unless 0 < b <= 2 R and 0 <= r <= X.
Section without_slot(const Section& section, double outer_mm, const Slot& slot);
Section without_flat(const Section& section, double outer_mm, double floor_mm,
                     double angle_rad);

/// Least second moment of area about an axis through the centroid [mm4]: the bending
/// stiffness in the softest direction, divided by E.  Source: the smaller principal moment.
/// @throws std::domain_error unless the section has an area.
double least_second_moment_mm4(const Section& section);

/// A length of the part with constant section.
struct Stretch {
  double length_mm = 0;
  Section section;
};

/// Deflection per newton in the direction of the force, over the angle psi through which
/// the part has turned:
///
///     c(psi) = mean + lobe cos(2 (psi - softest))                               (2)
struct OvalFlexibility {
  double mean_mm_N = 0, lobe_mm_N = 0;
  double softest_rad = 0;  ///< in [0, pi)
};

/// Flexibility of a part with keyways or flats.  A section without threefold symmetry
/// bends more easily in one direction than in another.  With T = [[xx, xy], [xy, yy]]
/// about its centroid, a deflection u = (u_x, u_y) and the moment m of a force, both as
/// vectors in the direction of the force, E T u'' = m.  A force in the direction n then
/// moves the part along n by n^T C n, with
///
///     C = int (arm^2/E) T^-1 dz,  T^-1 = [[yy, -xy], [-xy, xx]]/(xx yy - xy^2)  (3)
///
/// Over a length of constant section its mean is (xx + yy)/(2 det) and its amplitude
/// sqrt((xx - yy)^2/4 + xy^2)/det, so the mean is 1/2 (1/I_1 + 1/I_2), not 1/I of the
/// mean I.  A section of threefold or higher symmetry has xx = yy, xy = 0, and so no
/// lobe.  The arms are a - z (chuck), z b/L and (L - z) a/L (centres); between chuck and
/// tailstock, with such matrices f_aa, f_aL and f_LL,
///
///     C = f_aa - f_aL (f_LL + c_t)^-1 f_aL                                      (4)
///
/// Every C is symmetric, which gives (2).  Supports are the same in both planes.  Only
/// bending is counted: shear adds its part to the mean (see Beam), and next to nothing to
/// the lobe.  Neglects that the centroid lies beside the axis of rotation (torsion by
/// Ft). Source: derived here; round sections against Beam in ovality_test.
/// @throws std::domain_error unless E > 0, 0 <= a <= L and the sections have an area, or
/// if the supports are not elastic.
OvalFlexibility oval_flexibility(std::span<const Stretch> stretches, double E_MPa,
                                 const Supports& supports, double a_mm);

/// Radius error over a revolution under forces Fr and Ft of constant direction.  With n
/// along Fr and t along Ft, n^T C (Fr n + Ft t) = mean Fr + lobe (Fr cos 2x - Ft sin 2x),
///
///     mean = mean_mm_N Fr,  amplitude = lobe_mm_N sqrt(Fr^2 + Ft^2)             (5)
///
/// The surface has two lobes, from peak to valley twice the amplitude.
struct OvalError {
  double mean_mm = 0, amplitude_mm = 0;
};
OvalError oval_error(const OvalFlexibility& f, double Fr_N, double Ft_N);

}  // namespace turnwright::deflection
