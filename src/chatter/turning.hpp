#pragma once
#include <vector>

#include "chatter/fundamental_matrix/stability_crossings.hpp"
#include "turnwright/chatter/cutter.hpp"

namespace turnwright::chatter {

/// Every depth in (0, ap_max], rising, at which turning has an undamped vibration.  The
/// cut is the same at every angle, so that with s = i omega, q along x and the cutting
/// speed v
///
///     1 + w D(s) = 0,   D(s) = G(s) (K (1 - e^(-s tau)) + s C/v)                    (1)
///     G(s) = sum_i (wn_i^2/k_i) / (s^2 + 2 zeta_i wn_i s + wn_i^2)                  (2)
///
/// that is, Im D(i omega) = 0 and w = -1/Re D(i omega).  Because Re ds/dw has the sign of
/// d Im D/d omega, a pair of multipliers leaves the unit circle where Im D rises through
/// 0 and returns where it falls.  Frequencies beyond which w |D| < 1 need no search.
/// Ranges of the others are halved until an enclosure of D shows that a range holds no
/// zero or, by the sign of the slope, at most one.  Where Im D only touches 0 within
/// rounding a pair leaves and returns at one depth; such depths are omitted.
///
/// Source: [Tobias 1958] and [Tlusty 1963] for (1), with the indentation force of
/// cutter.hpp; the search derived here.
/// @param cutter  with a constant force.
/// @throws TooManyVibrations after kMostPieces.
std::vector<OnCircle> turning_on_circle(const Cutter& cutter, double n_rpm,
                                        double ap_max_mm);
inline constexpr long kMostPieces = 2'000'000;  // seconds

}  // namespace turnwright::chatter
