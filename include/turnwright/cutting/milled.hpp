#pragma once
#include "turnwright/catalogue/material.hpp"

/// Forces on a shank cutter with a square corner by Kienzle's law.  The chip of a tooth
/// at the angle phi (from y, across the feed) is ap wide and h = fz sin(phi) thick.
namespace turnwright::cutting {

/// Chip over a tooth's path through the cut, for the radial immersion a = ae/D in (0, 1]:
///
///     phi_c = acos(1 - 2 a)                                                          (1)
///     hex = fz max sin = fz 2 sqrt(a (1 - a)),   fz where a >= 1/2                   (2)
///     hm = fz int sin / phi_c = fz 2 a/phi_c                                         (3)
///
/// The same for up- and down-milling.  Source: geometry, derived here.
struct MilledChip {
  double arc_rad = 0;      ///< phi_c
  double hex_over_fz = 0;  ///< largest thickness
  double hm_over_fz = 0;   ///< mean thickness
};
MilledChip milled_chip(double immersion);

/// Force per chip thickness and depth of cut [MPa], in the form of chatter::LinearForce:
///
///     Kt = kc1.1 hm^-mc,   Kn = kf1.1 hm^-mf, else lambda Kt                         (4)
///
/// Kt is the secant of Kienzle's law at hm.  The slope there is (1 - mc) Kt, and its mean
/// over the tooth's path is below Kt, too; so Kt is on the safe side, by about a fifth in
/// steel.  Kn acts along the tooth's radius, as the feed force does in turning with
/// kappa = 90 deg; lambda is that of cut.hpp (5), whose ploughing makes no chip.
/// @param kc  with K_gamma of the cutter's rake, fixed.hpp.
struct ChipStiffness {
  double Kt_MPa = 0, Kn_MPa = 0;
};
ChipStiffness chip_stiffness(const catalogue::Kienzle& kc,
                             const catalogue::Material& material, double hm_mm);

/// Mean power at the cut [kW], from the rate of material removal; M is the mean torque:
///
///     P = kc1.1 hm^-mc ap ae vf/60e6,   vf = fz z n,   M = P/(2 pi n)                (5)
double milled_power_kW(const catalogue::Kienzle& kc, double hm_mm, double ap_mm,
                       double ae_mm, double vf_mm_min);

/// Factor S of the largest sum of the teeth's tangential forces over a revolution, which
/// is kc1.1 ap fz^(1-mc) S [N]:
///
///     S = max over phi of sum_j sin^(1-mc)(phi + 2 pi j/z),  teeth in the cut alone (6)
///
/// sampled at 720 angles of a tooth's pitch, which is exact to within 1e-5.
double teeth_sum(double arc_rad, int teeth, double mc);

}  // namespace turnwright::cutting
