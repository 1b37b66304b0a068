#pragma once
#include <complex>
#include <span>
#include <vector>

#include "turnwright/milling/limits.hpp"
#include "turnwright/milling/system.hpp"

/// Cutters whose edges are not straight, alike and free of friction on the flank.  In
/// place of (2) of system.hpp
///
///     F = -sum_j int_0^w g_j [h(phi_jz) (q(t) - q(t - tau_j)) + d(phi_jz) q'(t)] dz  (1)
///     phi_jz = phi_j - z 2 tan(helix)/D                                              (2)
///
/// z height of a point of the edge above the tip [mm], D diameter [mm]; g_j = 1 while
/// that point is in the cut; tau_j the time since the edge cut that made the surface now
/// met; d is h of (4) of system.hpp with C/v for Kn and friction C/v for Kt, C the
/// indentation force per depth [N/mm], v = pi D n/60 the cutting speed [mm/s].
///
/// With radii of the teeth R + offset_j and a feed f_l along x in the l pitches since
/// tooth j - l passed, the chip is
///
///     h_j(phi) = min over l of f_l sin(phi) + offset_j - offset_(j - l), l = 1 .. N  (3)
///
/// tooth j cuts where that is positive, and tau_j is the time of those l pitches.
///
/// Valid as system.hpp is; the diameter of the tool and the feed change h in no other
/// way: trochoids are circles, and delays do not depend on the chip.  Small vibrations do
/// not change which tooth met the surface last.
/// Source: derived here; (1) follows the literature's term of indentation,
/// F = -C w/v q', whose C is a measured value.
namespace turnwright::milling {

struct Cutter {
  System system;  ///< its force linear; or constant, without helix, pitches and offsets
  double helix_rad = 0;                ///< [0, pi/2)
  double diameter_mm = 0;              ///< > 0 if helix or indentation is not 0
  std::vector<double> pitch_rad = {};  ///< of tooth j from tooth j - 1; empty: equal
  std::vector<double> offset_mm = {};  ///< of the teeth's radii; empty: none
  double feed_mm = 0;                  ///< a tooth, in the mean; > 0 if there are offsets
  double indentation_N_mm = 0;         ///< C
  double friction = 0;                 ///< of the flank
  /// Whether teeth differ, so that multipliers belong to a revolution, not to a tooth.
  bool by_revolution() const { return !pitch_rad.empty() || !offset_mm.empty(); }
};

/// Period of the multipliers [s].
double period_s(const Cutter& cutter, double n_rpm);

/// As their namesakes of limits.hpp, by the multipliers of the delayed motion collocated
/// at depths, see src/milling/delay_map.hpp, between which their characteristic function
/// is interpolated until its tail is below 1e-9 of it, with a helix 1e-6, and counts as
/// noise, see src/milling/sheet.hpp.  What is searched for crossings is that function, so
/// that islands are not missed.
///
/// With teeth that differ a multiplier may be 1: `fold`.  Turning, with indentation or
/// without, is told in closed form, see src/milling/turning.hpp.
/// @throws ModelRangeError as its namesake, and if a period needs too many nodes.
SpeedLimits speed_limits(const Cutter& cutter, double n_rpm, double ap_max_mm,
                         std::span<const double> depths_mm = {});

/// `unstable` is what collocation counts, with two finenesses of nodes alike; `certified`
/// says that no multiplier is nearer the circle than ten times what their spectral radii
/// differ by.
/// @throws ModelRangeError if the two do not agree, or if a period needs too many nodes.
Multipliers multipliers(const Cutter& cutter, double n_rpm, double ap_mm);

/// The wall that a stable cut leaves: the motion of the tool that the feed forces, where
/// the teeth pass the wall,
///
///     left = min over teeth of -+q_y - offset_j                                      (4)
///
/// - where they enter (up-milling, phi = 0), + where they leave (down-milling, phi = pi).
struct Surface {
  bool up_milled = false;
  std::vector<double> height_mm;  ///< over the tip, from 0 to the depth
  std::vector<double> left_mm;    ///< material left on the wall; negative: cut too deep
};

/// The walls of a cut: two of a slot.  Means nothing of a cut that is not stable.
std::vector<Surface> surfaces(const Cutter& cutter, double n_rpm, double ap_mm);

}  // namespace turnwright::milling
