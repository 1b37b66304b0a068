#pragma once
#include "turnwright/catalogue/material.hpp"

/// Forces of a shank cutter with square corner from Kienzle's specific force: a tooth's
/// chip at the angle phi (from y, across the feed) is ap wide and h = fz sin(phi) thick.
namespace turnwright::cutting {

/// Chip of a tooth's way through the cut, a = ae/D the radial immersion in (0, 1]:
///
///     phi_c = acos(1 - 2 a)                                                          (1)
///     hex = fz max sin = fz 2 sqrt(a (1 - a)),   fz where a >= 1/2                   (2)
///     hm = fz int sin / phi_c = fz 2 a/phi_c                                         (3)
///
/// Alike in up- and down-milling.  Source: geometry, derived here.
struct MilledChip {
  double arc_rad = 0;      ///< phi_c
  double hex_over_fz = 0;  ///< largest thickness
  double hm_over_fz = 0;   ///< mean thickness
};
MilledChip milled_chip(double immersion);

/// Stiffness of the force against the chip, N per mm of thickness and mm of depth, as
/// chatter::LinearForce wants it:
///
///     Kt = kc1.1 hm^-mc,   Kn = kf1.1 hm^-mf, else 0.5 Kt                            (4)
///
/// Kt is the secant of Kienzle's law at hm.  Its slope is (1 - mc) Kt; the slope's mean
/// over the tooth's way stays below Kt too, so Kt is on the safe side, by about a fifth
/// in steel.  Kn acts along the tooth's radius, which is what the feed force is in
/// turning with kappa = 90 deg; 0.5 is that of cut.hpp (5), +-30 %.
/// @param kc  with K_gamma of the cutter's rake, fixed.hpp.
struct ChipStiffness {
  double Kt_MPa = 0, Kn_MPa = 0;
};
ChipStiffness chip_stiffness(const catalogue::Kienzle& kc,
                             const catalogue::Material& material, double hm_mm);

/// Mean power at the cut [kW] and mean torque [Nm], from what is removed:
///
///     P = kc1.1 hm^-mc ap ae vf/60e6,   vf = fz z n,   M = P/(2 pi n)                (5)
double milled_power_kW(const catalogue::Kienzle& kc, double hm_mm, double ap_mm,
                       double ae_mm, double vf_mm_min);

/// Largest sum of the teeth's tangential forces over a turn [N] is kc1.1 ap fz^(1-mc)
/// times
///
///     S = max over phi of sum_j sin^(1-mc)(phi + 2 pi j/z),  teeth in the cut alone (6)
///
/// found on 720 angles of a tooth's pitch, so to within 1e-5.
double teeth_sum(double arc_rad, int teeth, double mc);

}  // namespace turnwright::cutting
