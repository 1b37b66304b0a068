#pragma once
#include <vector>

#include "turnwright/chatter/system.hpp"

/// Cutters whose edges are not straight, alike and free of friction on the flank.  In
/// place of (2) of system.hpp
///
///     F = -sum_j int_0^w g_j [h(phi_jz) (q(t) - q(t - tau_j)) + d(phi_jz) q'(t)] dz  (1)
///     phi_jz = phi_j - z 2 tan(helix)/D                                              (2)
///
/// z height of a point of the edge above the tip [mm], D diameter [mm]; g_j = 1 while
/// that point is in the cut; tau_j the time since the surface that it meets was cut; d is
/// h of (4) of system.hpp with C/v for Kn and friction C/v for Kt, C the
/// indentation force per depth [N/mm], v = pi D n/60 the cutting speed [mm/s].
///
/// With radii of the teeth R + offset_j and a feed f_l along x in the l pitches since
/// tooth j - l passed, the chip is
///
///     h_j(phi) = min over l of f_l sin(phi) + offset_j - offset_(j - l), l = 1 .. N  (3)
///
/// Tooth j cuts where that is positive, and tau_j is the time of those l pitches.
///
/// Valid as system.hpp.  The diameter of the tool and the feed have no other effect on h:
/// trochoids count as circles, and delays do not depend on the chip.  Vibrations are so
/// small that they do not change which tooth cut the surface last.
/// Source: [Altintas 2008] for the indentation force F = -C w/v q', whose C is measured;
/// the rest derived here.
namespace turnwright::chatter {

struct Cutter {
  System system;  ///< with linear force, or constant if there is no helix, pitch, offset
  double helix_rad = 0;                ///< [0, pi/2)
  double diameter_mm = 0;              ///< > 0 if helix or indentation is not 0
  std::vector<double> pitch_rad = {};  ///< of tooth j from tooth j - 1; empty: equal
  std::vector<double> offset_mm = {};  ///< of the teeth's radii; empty: none
  double feed_mm = 0;                  ///< mean feed per tooth; > 0 if there are offsets
  double indentation_N_mm = 0;         ///< C
  double friction = 0;                 ///< coefficient of friction of the flank
  /// Whether teeth differ, so that multipliers belong to a revolution, not to a tooth.
  bool by_revolution() const { return !pitch_rad.empty() || !offset_mm.empty(); }
};

/// Period of the multipliers [s].
double period_s(const Cutter& cutter, double n_rpm);

}  // namespace turnwright::chatter
