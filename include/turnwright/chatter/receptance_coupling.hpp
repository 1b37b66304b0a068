#pragma once
#include <complex>
#include <span>

/// The receptance at a tool's tip from that of the spindle and the dimensions of holder and
/// tool, which are beams: so the overhang is a choice, not a measurement.
///
/// At the end of a part force F and couple C move it by y and turn it by psi:
///
///     (y, psi) = R (F, C),     R = [H, L; L, P]                                      (1)
///
/// Along a beam of constant section in harmonic motion e^(i w t), with the shear force Q and
/// the bending moment M that what follows exerts on what comes before,
///
///     y' = psi + Q/(kappa G A)   psi' = M/(E I)
///     Q' = -rho A w^2 y          M' = -Q - rho I w^2 psi                             (2)
///
/// whose solution over a length is (y, psi, Q, M)_2 = T (y, psi, Q, M)_1.  A beam that is
/// rigidly joined to a part with R_1 ends with
///
///     R_2 = (T_11 R_1 + T_12) (T_21 R_1 + T_22)^-1                                   (3)
///
/// That is receptance coupling, h_aa - h_ab (h_bb + R_1)^-1 h_ba with the receptances h of
/// the free beam, in a form that needs none of these.  Losses make E and G complex,
/// E (1 + i eta); kappa is that of [Cowper 1966] for a hollow circle,
///
///     kappa = 6 (1 + nu) (1 + m^2)^2 / ((7 + 6 nu) (1 + m^2)^2 + (20 + 12 nu) m^2)   (4)
///
/// m = bore/diameter; beams of Euler and Bernoulli have kappa G A infinite and no rho I.
///
/// Valid for joints that do not yield, sections that stay round, one plane of motion.
/// Source: [Schmitz 2000] and [Schmitz 2005] for the approach, [Timoshenko 1921] for (2);
/// (3) derived here, checked in receptance_coupling_test by finite elements.
namespace turnwright::chatter {

/// A length of holder or tool, a cylinder or a tube.
struct BeamSegment {
  double length_mm = 0;      ///< > 0
  double diameter_mm = 0;    ///< > 0; of a fluted part that of a cylinder as stiff
  double bore_mm = 0;        ///< in [0, diameter)
  double E_MPa = 0;          ///< > 0
  double nu = 0;             ///< in [0, 0.5)
  double density_kg_m3 = 0;  ///< > 0
  double loss_factor =
      0;  ///< eta >= 0, twice the damping ratio of a mode of the beam alone
};

enum class BeamTheory { timoshenko, euler_bernoulli };

/// R of (1).
struct EndReceptance {
  std::complex<double> H_mm_N, L_1_N, P_1_Nmm;
};

/// R of a part whose translation is H and which tilts about a point `pivot` behind its end:
/// L = H/pivot, P = H/pivot^2; with an infinite pivot it does not tilt.
EndReceptance tilting(std::complex<double> H_mm_N, double pivot_mm);

EndReceptance operator+(const EndReceptance& a, const EndReceptance& b);

/// R at the end of the last segment, by (3) for each.
/// @param start  R at the beginning of the first.
/// @param w_rad_s  > 0
EndReceptance at_the_end(const EndReceptance& start,
                         std::span<const BeamSegment> segments, BeamTheory theory,
                         double w_rad_s);

}  // namespace turnwright::chatter
